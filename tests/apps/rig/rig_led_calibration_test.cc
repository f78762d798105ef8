#include "apps/rig/rig_led_calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

constexpr const char* kSpheresAndPlanes =
    "spheres:\n"
    "  - {center_mm: [-24, -12, 8], radius_mm: 8, center_std_mm: 0.006, radius_std_mm: 0.002}\n"
    "  - {center_mm: [24, -14, 8], radius_mm: 7}\n"
    "planes:\n"
    "  - {origin_mm: [0, 0, 0], size_mm: [60, 44], albedo: [0.9, 0.92, 0.88]}\n"
    "  - {origin_mm: [0, 0, 15], size_mm: [60, 44], albedo: [0.9, 0.92, 0.88], "
    "albedo_relative_std: 0.005}\n";
constexpr const char* kLedShots =
    "shots:\n"
    "  - {file: s.dng, kind: spheres, light: led1}\n"
    "  - {file: p.dng, kind: plane, plane: 2, light: led2, exposure_s: 0.125}\n"
    "  - {file: dark.dng, kind: ambient, plane: 2}\n";

calib::LedCalibrationShots led_shots_of(const std::string& text) {
  return read_led_calibration(yaml_text(text), "rig.yaml");
}
std::string led_shots_refused(const std::string& text) {
  return refusal_of([&] { led_shots_of(text); });
}

TEST(RigLedCalibration, ReadsSpheresPlanesAndShots) {
  const calib::LedCalibrationShots c =
      led_shots_of(std::string(kSpheresAndPlanes) + "ambient: fitted\n" + kLedShots);
  ASSERT_EQ(c.spheres.size(), 2U);
  EXPECT_EQ(c.spheres[0].center_mm, Eigen::Vector3d(-24, -12, 8));
  EXPECT_EQ(c.spheres[0].radius_mm, 8.0);
  EXPECT_EQ(c.spheres[0].center_std_mm, 0.006);
  EXPECT_EQ(c.spheres[0].radius_std_mm, 0.002);
  EXPECT_EQ(c.spheres[1].center_std_mm, 0.0);
  ASSERT_EQ(c.planes.size(), 2U);
  EXPECT_EQ(c.planes[1].origin_mm.z(), 15.0);
  EXPECT_EQ(c.planes[0].albedo_relative_std, 0.0);
  EXPECT_EQ(c.planes[1].albedo_relative_std, 0.005);
  EXPECT_EQ(c.ambient, calib::AmbientModel::kFitted);
  ASSERT_EQ(c.shots.size(), 3U);
  EXPECT_EQ(c.shots[0].kind, calib::LedShotKind::kSpheres);
  EXPECT_EQ(c.shots[0].light, "led1");
  EXPECT_EQ(c.shots[1].kind, calib::LedShotKind::kPlane);
  EXPECT_EQ(c.shots[1].plane, 1U);  // counted from 1 in the file
  EXPECT_EQ(c.shots[1].exposure_s, 0.125);
  EXPECT_EQ(c.shots[2].kind, calib::LedShotKind::kAmbient);
  EXPECT_EQ(c.shots[2].light, "");
  EXPECT_EQ(c.lights(), (std::vector<std::string>{"led1", "led2"}));
  EXPECT_EQ(c.ambient_shot(1), 2U);
  EXPECT_FALSE(c.ambient_shot(0).has_value());
}

TEST(RigLedCalibration, AmbientModels) {
  const std::string all = std::string(kSpheresAndPlanes) + kLedShots;
  EXPECT_EQ(led_shots_of(all).ambient, calib::AmbientModel::kWhereSeen);
  EXPECT_EQ(led_shots_of(all + "ambient: none\n").ambient, calib::AmbientModel::kNone);
  EXPECT_EQ(led_shots_of(all + "ambient: where_seen\n").ambient, calib::AmbientModel::kWhereSeen);
  EXPECT_THAT(led_shots_refused(all + "ambient: maybe\n"),
              HasSubstr("expected where_seen, fitted or none, got maybe"));
}

TEST(RigLedCalibration, NamesWhatIsWrong) {
  const auto shot = [](const std::string& fields, const std::string& more = "") {
    return led_shots_refused(std::string(kSpheresAndPlanes) + "shots:\n  - {" + fields + "}\n" +
                             more);
  };
  EXPECT_EQ(shot("file: a.dng, kind: spheres, light: led1"), "");
  EXPECT_THAT(shot("file: a.dng, kind: cubes, light: led1"),
              HasSubstr("expected spheres, plane or ambient, got cubes"));
  EXPECT_THAT(shot("file: a.dng, kind: plane, light: led1"), HasSubstr("there are several planes"));
  EXPECT_THAT(shot("file: a.dng, kind: plane, plane: 3, light: led1"), HasSubstr("shots[0].plane"));
  EXPECT_THAT(shot("file: a.dng, kind: plane, plane: 0, light: led1"), HasSubstr("shots[0].plane"));
  EXPECT_THAT(shot("file: a.dng, kind: plane, plane: 1"), HasSubstr("light: is missing"));
  EXPECT_THAT(shot("file: a.dng, kind: spheres, plane: 1, light: led1"),
              HasSubstr("shots[0].plane: is given in a shot of the spheres"));
  EXPECT_THAT(shot("file: a.dng, kind: ambient, plane: 1, light: led1"),
              HasSubstr("every LED is off"));
  EXPECT_THAT(
      shot("file: a.dng, kind: ambient, plane: 1", "  - {file: b.dng, kind: ambient, plane: 1}\n"),
      HasSubstr("the plane has two ambient shots"));
  EXPECT_THAT(shot("file: a.dng, kind: spheres, light: led1",
                   "  - {file: a.dng, kind: spheres, light: led2}\n"),
              HasSubstr("shots[1].file: two shots of the same name"));
  EXPECT_THAT(led_shots_refused("shots: [{file: a.dng, kind: plane, light: led1}]\n"),
              HasSubstr("there are no planes in the rig"));
  EXPECT_THAT(led_shots_refused("shots: [{file: a.dng, kind: spheres, light: led1}]\n"),
              HasSubstr("there are no spheres in the rig"));
  EXPECT_THAT(led_shots_refused("shots: []\n"), HasSubstr("at least one shot"));
}

// The only plane need not be named.
TEST(RigLedCalibration, OnePlaneIsMeant) {
  const calib::LedCalibrationShots c = led_shots_of(
      "planes: [{size_mm: [60, 44], albedo: [1, 1, 1]}]\n"
      "shots: [{file: a.dng, kind: plane, light: led1}]\n");
  EXPECT_EQ(c.shots.at(0).plane, 0U);
}

}  // namespace
}  // namespace scattermeter::apps
