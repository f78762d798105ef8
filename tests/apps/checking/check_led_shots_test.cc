#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckLedShots, WithoutShotsNothing) {
  const MadeCheckedRig made(1);
  EXPECT_TRUE(check_led_shots(made.checked).empty());
}

TEST(CheckLedShots, ByHand) {
  MadeCheckedRig made(1);
  calib::LedCheck& led = made.checked.leds.emplace_back();
  led.light = "led1";
  led.highlight_worst_px = 0.5;
  led.plane_rms_percent = 1.0;
  led.ambient_percent = 0.8;
  led.ambient_std_percent = 0.1;
  led.ambient_file = "low.dng";
  led.power_change_percent = {0.5, -1.0, 1.5};
  led.displacement_length_mm = 0.3;
  led.displacement_stds = 2.0;
  led.text = "led1 stands 0.3 mm off";
  std::vector<CheckItem> items = check_led_shots(made.checked);
  ASSERT_EQ(items.size(), 5U);
  const char* names[] = {"LED highlights", "LED places, from their shots",
                         "white plane under the LEDs", "light beside the LEDs on the white plane",
                         "LED power, from the white plane"};
  const double worst[] = {0.5, 0.3, 1.0, 0.8, 1.5};
  const char* where[] = {"led1", "led1", "led1", "led1 low.dng", "led1 B"};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(items[i].what, names[i]);
    EXPECT_TRUE(items[i].passed) << names[i];
    EXPECT_EQ(items[i].worst, worst[i]) << names[i];
    EXPECT_EQ(items[i].where, where[i]) << names[i];
  }
  EXPECT_NEAR(items[1].details[0].std, 0.15, 1e-12);
  led.highlight_worst_px = 1.1;
  led.plane_rms_percent = 2.1;
  led.ambient_percent = 1.2;
  led.power_change_percent[1] = -2.1;
  led.displacement_length_mm = 0.6;
  led.displacement_stds = 6.0;
  items = check_led_shots(made.checked);
  for (const CheckItem& item : items) EXPECT_FALSE(item.passed) << item.what;
  EXPECT_EQ(items[1].advice, "led1 stands 0.3 mm off");
  EXPECT_EQ(items[4].worst, -2.1);
}

// Planes alone: no highlight, and nothing of the place where the shots do not tell it.
TEST(CheckLedShots, PartsThatAreNotThere) {
  MadeCheckedRig made(1);
  const double none = std::numeric_limits<double>::quiet_NaN();
  calib::LedCheck& led = made.checked.leds.emplace_back();
  led.light = "led1";
  led.highlight_worst_px = none;
  led.plane_rms_percent = 1.0;
  led.power_change_percent.setZero();
  led.problem = "too few highlights";
  std::vector<CheckItem> items = check_led_shots(made.checked);
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items[0].what, "white plane under the LEDs");
  led.plane_rms_percent = led.ambient_percent = none;
  led.power_change_percent.setConstant(none);
  led.highlight_worst_px = 0.1;
  items = check_led_shots(made.checked);
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(items[0].what, "LED highlights");
}

}  // namespace
}  // namespace scattermeter::apps
