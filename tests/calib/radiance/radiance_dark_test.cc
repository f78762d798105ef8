#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/radiance/radiance_steps.h"
#include "tests/fixtures/calib/radiance_bench.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

// Two frames of each of three times, 3 counts a second of dark current, pixel 1000 hot.
void add_dark_frames(RadianceBench& bench, std::initializer_list<double> times) {
  for (const double t : times) {
    for (int i = 0; i < 2; ++i) {
      bench.input.shots.dark.push_back(bench.shot("dark", t, [](int x, int y) {
        return y * RadianceBench::kWidth + x == 1000 ? 300.0 : 3.0;
      }));
    }
  }
}

TEST(RadianceDark, FindsBlackDarkCurrentAndHotPixels) {
  RadianceBench bench;
  add_dark_frames(bench, {0.1, 0.5, 2.0});
  find_dark(bench.steps);
  const capture::RadianceCorrection& c = bench.calibration.correction;
  EXPECT_EQ(c.defect_pixels, std::vector<std::size_t>{1000});
  // A mean of 1536 samples of 1.6 counts: 0.04 counts.
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_NEAR(c.black_counts[p], 64.0, 0.15);
    EXPECT_NEAR(c.dark_counts_per_s[p], 3.0, 0.15);
  }
  EXPECT_LT(c.black_std_counts, 0.15);
  EXPECT_TRUE(bench.calibration.notes.empty());
  ASSERT_EQ(bench.calibration.residuals.size(), 1U);
  EXPECT_LT(bench.calibration.residuals[0].rms, 0.15);
}

TEST(RadianceDark, OneExposureTimeLeavesTheDarkCurrentInTheBlack) {
  RadianceBench bench;
  add_dark_frames(bench, {2.0});
  find_dark(bench.steps);
  EXPECT_EQ(bench.calibration.correction.dark_counts_per_s[0], 0.0);
  EXPECT_NEAR(bench.calibration.correction.black_counts[0], 70.0, 0.2);
  ASSERT_FALSE(bench.calibration.notes.empty());
  EXPECT_THAT(bench.calibration.notes[0], HasSubstr("the same exposure time"));
}

TEST(RadianceDark, RefusesLightOnAFrame) {
  const auto refusal = [](const RadianceBench::Light& light) {
    RadianceBench bench;
    add_dark_frames(bench, {0.1, 0.5});
    bench.input.shots.dark.push_back(bench.shot("lit", 0.5, light));
    return refusal_of([&] { find_dark(bench.steps); });
  };
  EXPECT_EQ(refusal([](int, int) { return 3.0; }), "");
  // Everywhere, on one side, and a little everywhere: beyond the range, uneven, off the others.
  EXPECT_THAT(refusal([](int, int) { return 400.0; }), HasSubstr("above the file's black"));
  EXPECT_THAT(refusal([](int x, int) { return x < 48 ? 0.0 : 12.0; }), HasSubstr("parts of it"));
  const std::string step = refusal([](int, int) { return 30.0; });
  EXPECT_THAT(step, HasSubstr("lit4.dng"));
  EXPECT_THAT(step, HasSubstr("off those of the others"));
}

}  // namespace
}  // namespace scattermeter::calib
