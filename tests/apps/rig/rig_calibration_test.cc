#include "apps/rig/rig_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

constexpr const char* kCameraPart =
    "camera: {board: {type: chessboard, squares: [9, 7], square_mm: 25}, shots: [{file: c.dng}]}\n";
constexpr const char* kLedPart =
    "led: {spheres: [{center_mm: [0, 0, 8], radius_mm: 8}], shots: [{file: l.dng, kind: spheres, "
    "light: led1}]}\n";
constexpr const char* kRadiancePart = "radiance: {dark: [d.dng], flats: [f.dng]}\n";

TEST(RigCalibration, EveryPartGoesWhereItBelongs) {
  const RigCalibration all = read_calibration(
      yaml_text(std::string(kCameraPart) + kLedPart + kRadiancePart), "some/rig.yaml");
  ASSERT_TRUE(all.camera && all.led && all.radiance);
  EXPECT_EQ(all.camera->shots.at(0).file, "c.dng");
  EXPECT_EQ(all.led->shots.at(0).file, "l.dng");
  EXPECT_EQ(all.radiance->flats.at(0).file, "f.dng");
  EXPECT_EQ(all.camera->at(all.camera->line), "some/rig.yaml:1");
  EXPECT_EQ(all.led->at(all.led->line), "some/rig.yaml:2");
  EXPECT_EQ(all.radiance->at(all.radiance->line), "some/rig.yaml:3");
}

TEST(RigCalibration, EveryPartMayBeAbsent) {
  const RigCalibration led = read_calibration(yaml_text(kLedPart), "rig.yaml");
  EXPECT_TRUE(led.led.has_value());
  EXPECT_FALSE(led.camera || led.radiance);
  EXPECT_THAT(refusal_of([] { read_calibration(yaml_text("lens: {}\n"), "rig.yaml"); }),
              HasSubstr("lens: unknown key"));
}

}  // namespace
}  // namespace scattermeter::apps
