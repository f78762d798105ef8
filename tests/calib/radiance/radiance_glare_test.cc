#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/radiance/radiance_steps.h"
#include "tests/fixtures/calib/radiance_bench.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

// A bright field of 20000 counts a second in the middle, two traps beside it, and 2 % of the
// frame's mean of glare.
class RadianceGlareTest : public ::testing::Test {
 protected:
  RadianceGlareTest() {
    bench_.know_dark();
    GlareTarget target;
    target.shots = {bench_.shot("glare", 0.1, light, 1.0, false)};
    target.traps_px = {{4, 8, 20, 40}, {72, 8, 20, 40}};
    target.line = 12;
    bench_.input.shots.glare = target;
  }
  static bool is_bright(int x, int y) { return x >= 32 && x < 64 && y >= 16 && y < 48; }
  static double light(int x, int y) {
    // With glare g of the light's mean m the frame's mean is (1 + g) m, of which g / (1 + g) is
    // glare.
    const double mean = 20'000.0 * (32.0 * 32.0) / (96.0 * 64.0);
    return (is_bright(x, y) ? 20'000.0 : 0.0) + 0.02 * mean;
  }
  std::string refusal() {
    return refusal_of([&] { find_glare(bench_.steps); });
  }

  RadianceBench bench_;
};

TEST_F(RadianceGlareTest, IsTheTrapsShareOfTheMean) {
  find_glare(bench_.steps);
  for (std::size_t c = 0; c < kRgb; ++c) {
    // 6.7 counts, rounded to 7, of 340.
    const double mean = 20'000.0 / 6.0 * 0.1;
    const double recorded = std::round(0.02 * mean);
    EXPECT_NEAR(bench_.calibration.correction.glare_share[c], recorded / (mean + recorded), 2e-4);
    EXPECT_GT(bench_.calibration.correction.glare_std[c], 0.0);
  }
  ASSERT_EQ(bench_.calibration.residuals.size(), 1U);
}

TEST_F(RadianceGlareTest, WithoutAShotThereIsNone) {
  bench_.input.shots.glare.reset();
  find_glare(bench_.steps);
  EXPECT_EQ(bench_.calibration.correction.glare_share[0], 0.0);
  ASSERT_EQ(bench_.calibration.notes.size(), 1U);
  EXPECT_THAT(bench_.calibration.notes[0], HasSubstr("no glare shot"));
}

TEST_F(RadianceGlareTest, RefusesTrapsOutOfTheFrameOrInTheLight) {
  bench_.input.shots.glare->traps_px[1].x0 = 80;
  EXPECT_THAT(refusal(), HasSubstr("leaves the frame"));
  bench_.input.shots.glare->traps_px[1] = {36, 20, 10, 10};
  EXPECT_THAT(refusal(), HasSubstr("the trap at [36, 20]"));
}

TEST_F(RadianceGlareTest, RefusesAClippedFrame) {
  bench_.input.shots.glare->shots = {bench_.shot("bright", 1.0, light, 1.0, false)};
  EXPECT_THAT(refusal(), HasSubstr("of the samples are clipped"));
}

}  // namespace
}  // namespace scattermeter::calib
