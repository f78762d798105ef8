#include "capture/sensor/radiance_correction.h"

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

TEST(RadianceCorrection, SettingsAreFoundByTheirStatedTime) {
  RadianceCorrection c;
  c.shutter = {{1.0 / 60, 0.94, 0.001}, {1.0 / 30, 0.95, 0.002}};
  c.shutter_relative_std = 0.03;
  EXPECT_EQ(c.setting(0.016666).true_over_stated, 0.94);  // as a file's rational has it
  EXPECT_EQ(c.setting(1.0 / 30).relative_std, 0.002);
  const ShutterSetting other = c.setting(1.0 / 50);
  EXPECT_EQ(other.true_over_stated, 1.0);
  EXPECT_EQ(other.relative_std, 0.03);
}

}  // namespace
}  // namespace scattermeter::capture
