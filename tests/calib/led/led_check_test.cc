#include "calib/led/led_check.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/led_bench.h"

namespace scattermeter::calib {
namespace {

TEST(LedCheck, AnLedWhereTheRigSaysIsThere) {
  const LedBench bench;
  const LedCheck check = check_led(bench.input, "led", bench.frames());
  EXPECT_EQ(check.problem, "");
  EXPECT_LT(check.highlight_worst_px, 0.05);
  EXPECT_LT(check.plane_rms_percent, 0.2);
  for (const double percent : check.power_change_percent) EXPECT_NEAR(percent, 0.0, 0.2);
  EXPECT_LT(check.displacement_length_mm, 0.4);
  EXPECT_EQ(check.maps.size(), 1U);
  EXPECT_EQ(check.highlight_residuals_px.size(), 3U);
}

// The rig has it 2 mm aside and a tenth too bright.
TEST(LedCheck, FindsADisplacementAndAChangeOfPower) {
  LedBench bench;
  bench.input.leds[0].led.position_mm.x() -= 2.0;
  bench.input.leds[0].led.intensity_W_per_sr *= 1.1;
  const LedCheck check = check_led(bench.input, "led", bench.frames());
  ASSERT_EQ(check.problem, "");
  EXPECT_NEAR(check.displacement_mm.x(), 2.0, 0.4);
  EXPECT_NEAR(check.displacement_length_mm, 2.0, 0.4);
  EXPECT_GT(check.displacement_stds, 5.0);
  EXPECT_GT(check.highlight_rms_px, 0.1);
  // The prior is wrong in position as well: some per cent.
  for (const double percent : check.power_change_percent) EXPECT_NEAR(percent, -9.1, 4.0);
  EXPECT_THAT(check.text, ::testing::StartsWith("led "));
  // The prior's own 0.1 mm are part of the deviation.
  EXPECT_GE(check.displacement_std_mm, 0.1);
}

}  // namespace
}  // namespace scattermeter::calib
