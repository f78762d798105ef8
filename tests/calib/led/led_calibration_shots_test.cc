#include "calib/led/led_calibration_shots.h"

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

LedCalibrationShots shots_of_two_leds() {
  LedCalibrationShots out;
  out.path = "rig.yaml";
  const auto add = [&](const std::string& file, LedShotKind kind, std::size_t plane,
                       const std::string& light) {
    LedCalibrationShot shot;
    shot.file = file;
    shot.kind = kind;
    shot.plane = plane;
    shot.light = light;
    out.shots.push_back(shot);
  };
  add("off.dng", LedShotKind::kAmbient, 1, "");
  add("a.dng", LedShotKind::kSpheres, 0, "led2");
  add("b.dng", LedShotKind::kPlane, 0, "led1");
  add("c.dng", LedShotKind::kPlane, 1, "led2");
  return out;
}

TEST(LedCalibrationShots, LightsAreInTheOrderOfTheirFirstShots) {
  EXPECT_EQ(shots_of_two_leds().lights(), (std::vector<std::string>{"led2", "led1"}));
  EXPECT_TRUE(LedCalibrationShots().lights().empty());
}

TEST(LedCalibrationShots, AmbientShotBelongsToItsPlane) {
  const LedCalibrationShots shots = shots_of_two_leds();
  EXPECT_EQ(shots.ambient_shot(0), std::nullopt);
  EXPECT_EQ(shots.ambient_shot(1), std::size_t{0});
}

TEST(LedCalibrationShots, MessagesNameFileAndLine) {
  EXPECT_EQ(shots_of_two_leds().at(12), "rig.yaml:12");
}

}  // namespace
}  // namespace scattermeter::calib
