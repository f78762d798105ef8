#include "apps/rig/rig.h"

#include <gtest/gtest.h>

#include "capture/sensor/radiance_calibration.h"

namespace scattermeter::apps {
namespace {

TEST(Rig, FilesOfCalibrationsAreNoShots) {
  Rig rig;
  EXPECT_TRUE(calibration_files(rig).empty());
  SceneShot shot;
  shot.file = "shot.dng";
  rig.scene.shots = {shot};
  rig.pose.board_shot = "board.dng";
  rig.calibration.camera.emplace().shots = {{"camera.dng", {}, 0}};
  calib::LedCalibrationShot led;
  led.file = "led.dng";
  rig.calibration.led.emplace().shots = {led, led};
  calib::RadianceCalibrationShots& radiance = rig.calibration.radiance.emplace();
  const auto named = [](const char* file) { return calib::RadianceShot{file, {}, 1, 0}; };
  radiance.dark = {named("dark.dng")};
  radiance.flats = {named("flat.dng")};
  EXPECT_EQ(calibration_files(rig),
            (std::set<std::string>{"board.dng", "camera.dng", "dark.dng", "flat.dng", "led.dng"}));
  radiance.white.emplace().shots = {named("white1.dng"), named("white2.dng")};
  radiance.glare.emplace().shots = {named("glare.dng")};
  EXPECT_EQ(calibration_files(rig),
            (std::set<std::string>{"board.dng", "camera.dng", "dark.dng", "flat.dng", "glare.dng",
                                   "led.dng", "white1.dng", "white2.dng"}));
}

// The responsivity stays what the rig says; the glare that is left is the calibration's.
TEST(Rig, UseRadiance) {
  Rig rig;
  rig.scene.camera.responsivity = {1e10, 2e10, 3e10};
  auto radiance = std::make_shared<capture::RadianceCalibration>();
  radiance->correction.glare_std = {0.001, 0.002, 0.003};
  radiance->responsivity = {4e10, 5e10, 6e10};
  use_radiance(rig, radiance, "radiance.yaml");
  EXPECT_EQ(rig.decoding.radiance, radiance);
  EXPECT_EQ(rig.decoding.radiance_path, "radiance.yaml");
  EXPECT_EQ(rig.scene.camera.glare_std, (std::array<double, 3>{0.001, 0.002, 0.003}));
  EXPECT_EQ(rig.scene.camera.responsivity, (std::array<double, 3>{1e10, 2e10, 3e10}));
  use_radiance(rig, nullptr);
  EXPECT_EQ(rig.decoding.radiance, nullptr);
  EXPECT_EQ(rig.decoding.radiance_path, "");
  EXPECT_EQ(rig.scene.camera.glare_std, (std::array<double, 3>{}));
}

TEST(Rig, NamesItsLines) {
  Rig rig;
  rig.path = "a/rig.yaml";
  EXPECT_EQ(rig.at(12), "a/rig.yaml:12");
}

}  // namespace
}  // namespace scattermeter::apps
