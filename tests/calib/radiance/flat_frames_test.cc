#include "calib/radiance/flat_frames.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/radiance_bench.h"

namespace scattermeter::calib {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

double even(int /*x*/, int /*y*/) { return 10'000.0; }

class FlatFramesTest : public ::testing::Test {
 protected:
  FlatFramesTest() { bench_.know_dark(); }

  void add(std::initializer_list<double> times, double lamp = 1.0, int each = 2) {
    for (const double t : times) {
      for (int i = 0; i < each; ++i) {
        bench_.input.shots.flats.push_back(bench_.shot(
            "flat", t, [&](int x, int y) { return lamp * even(x, y); }, lamp));
      }
    }
  }
  std::string refusal() {
    return refusal_of([&] { open_flats(bench_.steps); });
  }

  RadianceBench bench_;
};

TEST_F(FlatFramesTest, GathersSettingsLampsAndPairs) {
  add({0.05, 0.1, 0.2});
  add({0.1}, 0.5);
  const FlatFrames flats = open_flats(bench_.steps);
  EXPECT_THAT(flats.settings_s, ElementsAre(0.05, 0.1, 0.2));
  EXPECT_THAT(flats.lamps, ElementsAre(1.0, 0.5));
  EXPECT_EQ(flats.range_counts, 4095.0 - 64.0);
  ASSERT_EQ(flats.shots.size(), 8U);
  EXPECT_EQ(flats.shots[7].setting, 1U);
  EXPECT_EQ(flats.shots[7].lamp, 1U);
  // 6 x 4 rectangles of 16 px, four blocks each, and four pairs.
  const std::size_t blocks = 6 * 4 * 4;
  ASSERT_EQ(bench_.steps.blocks.size(), blocks);
  ASSERT_EQ(flats.transfer.size(), 4 * blocks);
  EXPECT_FALSE(flats.dark_pairs);
  EXPECT_TRUE(bench_.calibration.notes.empty());
  double mean = 0, variance = 0;
  for (std::size_t k = 0; k < blocks; ++k) {
    // 64 samples of 1000 counts +- 13.
    EXPECT_NEAR(flats.shots[2].means[k].counts, 1000.0, 6 * 13.0 / 8);
    mean += flats.transfer[blocks + k].pair.counts / static_cast<double>(blocks);
    variance += flats.transfer[blocks + k].pair.variance_counts2 / static_cast<double>(blocks);
  }
  // Photons, read noise and rounding; a variance of 6000 samples is known to 2 %.
  EXPECT_NEAR(mean, 1000.0, 1.0);
  EXPECT_NEAR(variance / (1000.0 / 6.0 + 1.44 + 1.0 / 12), 1.0, 0.09);
}

TEST_F(FlatFramesTest, PairsOfDarkFramesGiveTheReadNoise) {
  add({0.05, 0.1, 0.2});
  for (const double t : {0.1, 0.1, 0.5}) {
    bench_.input.shots.dark.push_back(bench_.shot("dark", t, no_light));
  }
  const FlatFrames flats = open_flats(bench_.steps);
  EXPECT_TRUE(flats.dark_pairs);
  const std::size_t blocks = bench_.steps.blocks.size();
  ASSERT_EQ(flats.transfer.size(), 4 * blocks);
  double variance = 0;
  for (std::size_t k = 3 * blocks; k < 4 * blocks; ++k) {
    EXPECT_DOUBLE_EQ(flats.transfer[k].quantisation_counts2, 1.0 / 12);
    variance += flats.transfer[k].pair.variance_counts2 / static_cast<double>(blocks);
  }
  EXPECT_NEAR(variance / (1.44 + 1.0 / 12), 1.0, 0.09);
}

TEST_F(FlatFramesTest, NotesAFlatWithoutAPartner) {
  add({0.05, 0.1});
  add({0.2}, 1.0, 1);
  open_flats(bench_.steps);
  ASSERT_EQ(bench_.calibration.notes.size(), 1U);
  EXPECT_THAT(bench_.calibration.notes[0], HasSubstr("the flat of 0.2 s has no partner"));
}

TEST_F(FlatFramesTest, NeedsPairsAndThreeTimes) {
  add({0.05, 0.1, 0.2}, 1.0, 1);
  EXPECT_THAT(refusal(), HasSubstr("no two flats of equal exposure time and lamp among 3"));
  bench_.input.shots.flats.clear();
  add({0.05, 0.1});
  EXPECT_THAT(refusal(), HasSubstr("rig.yaml:5: calibration.radiance.flats"));
  EXPECT_THAT(refusal(), HasSubstr("2 exposure times"));
}

TEST_F(FlatFramesTest, RefusesFlatsThatAreClippedOrDark) {
  add({0.5});
  EXPECT_THAT(refusal(), HasSubstr("clipped in 100 % of the frame"));
  bench_.input.shots.flats.clear();
  add({0.001});
  EXPECT_THAT(refusal(), HasSubstr("expose longer"));
}

}  // namespace
}  // namespace scattermeter::calib
