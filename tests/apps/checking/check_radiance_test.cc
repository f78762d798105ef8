#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/radiance_shots.h"
#include "capture/sensor/radiance_calibration.h"
#include "tests/fixtures/apps/made_checked_rig.h"
#include "tests/fixtures/apps/radiance_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckRadiance, WithoutACalibrationNothing) {
  const MadeCheckedRig made(1);
  EXPECT_TRUE(check_radiance(made.checked).empty());
}

TEST(CheckRadiance, ResidualsOfTheCalibration) {
  MadeCheckedRig made(1);
  auto radiance = std::make_shared<capture::RadianceCalibration>();
  radiance->residuals = {{"flats", 0.2, -0.9, 0.3, "%"}, {"noise", 2.0, 3.0, 1.0, "counts"}};
  made.rig.decoding.radiance = radiance;
  const std::vector<CheckItem> items = check_radiance(made.checked);
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].what, "calibration: flats");
  EXPECT_TRUE(items[0].passed);
  EXPECT_EQ(items[0].rms, 0.2);
  EXPECT_EQ(items[0].worst, -0.9);
  EXPECT_EQ(items[0].limit, 0.3);
  EXPECT_EQ(items[0].unit, "% (limit of rms)");
  EXPECT_FALSE(items[1].passed);
}

// The dark frames of the folder, at black or 3 counts above it, even or not, at the shots' ISO.
TEST(CheckRadiance, DarkFrames) {
  Rig rig = radiance_rig();
  rig.truth.sensor = {};
  rig.scene.camera.iso = 100;
  rig.calibration.radiance->dark.resize(2);
  const TemporaryFolder folder;
  const auto shoot = [&](std::size_t i) {
    const RadianceShots shots(rig, true);
    const calib::RadianceShot& dark = rig.calibration.radiance->dark[i];
    shots.write(dark, 1, folder / dark.file);
  };
  CheckedRig checked{rig, {}, {}, {}, {}, {}, {}, {}, folder.path(), {}, {}, {}};
  EXPECT_TRUE(check_radiance(checked).empty());  // they need not be there
  shoot(0);
  std::vector<CheckItem> items = check_radiance(checked);
  ASSERT_EQ(items.size(), 3U);
  for (const CheckItem& item : items) {
    EXPECT_TRUE(item.passed) << item.what;
    EXPECT_EQ(item.details.size(), 1U);
  }
  ObservedShot shot;
  shot.iso = 200;
  checked.shots = {shot};
  rig.truth.sensor.dark_current_counts_per_s = 150.0;  // 3 counts in 0.02 s
  shoot(1);
  items = check_radiance(checked);
  EXPECT_EQ(items[0].what, "ISO of dark frames");
  EXPECT_FALSE(items[0].passed);
  EXPECT_NEAR(items[0].worst, -50.0, 1e-9);
  EXPECT_EQ(items[1].what, "level of dark frames");
  EXPECT_FALSE(items[1].passed);
  EXPECT_EQ(items[1].where, rig.calibration.radiance->dark[1].file);
  EXPECT_NEAR(items[1].worst, 3.0, 0.2);
  EXPECT_EQ(items[2].what, "evenness of dark frames");
  EXPECT_TRUE(items[2].passed);
}

}  // namespace
}  // namespace scattermeter::apps
