#include "apps/rig/rig_light_reader.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/scene/default_uncertainty.h"
#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

SceneLight light_of(const std::string& fields, const std::string& rig_path = "a/rig.yaml") {
  return read_light("hall", yaml_text("hall: {" + fields + "}\n").at("hall"), rig_path, {});
}
std::string light_refused(const std::string& fields) {
  return refusal_of([&] { light_of(fields); });
}

const std::string kLed =
    "type: led, position_mm: [30, -60, 80], axis: [0, 3, -4], intensity_W_per_sr: [0.05, 0, 0.04]";

TEST(RigLightReader, Led) {
  const SceneLight light =
      light_of(kLed +
               ", exponent: 1.3, radius_mm: 2, position_std_mm: 0.1, exponent_std: 0.05, "
               "intensity_relative_std: 0.01");
  EXPECT_EQ(light.name, "hall");
  EXPECT_EQ(light.line, 1);
  EXPECT_TRUE(light.files.empty());
  ASSERT_NE(light.led(), nullptr);
  const LedLight& led = *light.led();
  EXPECT_EQ(led.led.position_mm, Eigen::Vector3d(30, -60, 80));
  EXPECT_NEAR((led.led.axis - Eigen::Vector3d(0, 0.6, -0.8)).norm(), 0.0, 1e-15);
  EXPECT_EQ(led.led.exponent, 1.3);
  EXPECT_EQ(led.led.radius_mm, 2.0);
  EXPECT_EQ(led.led.intensity_W_per_sr[0], 0.05);
  EXPECT_EQ(led.led.intensity_W_per_sr[1], 0.0);
  EXPECT_EQ(led.led.intensity_W_per_sr[2], 0.04);
  EXPECT_EQ(led.position_std_mm, 0.1);
  EXPECT_EQ(led.exponent_std, 0.05);
  EXPECT_EQ(led.intensity_relative_std, 0.01);
  EXPECT_FALSE(led.calibrated || led.calibrated_for);
}

TEST(RigLightReader, AnLedIsAPointKnownToACarefulUser) {
  const SceneLight light = light_of(kLed);
  EXPECT_EQ(light.led()->led.exponent, 1.0);
  EXPECT_EQ(light.led()->led.radius_mm, 0.0);
  EXPECT_EQ(light.led()->position_std_mm, default_uncertainty::kLedPosition_mm);
  EXPECT_EQ(light.led()->exponent_std, default_uncertainty::kLedExponent);
  EXPECT_EQ(light.led()->intensity_relative_std, default_uncertainty::kLedIntensity);
}

// A table stands for the power; how far it may be wrong is stated as for the power.
TEST(RigLightReader, LedOfATabulatedLobe) {
  const std::string table = ", lobe: {angle_deg: [0, 45, 90], relative: [1, 0.6, 0]}";
  const SceneLight light = light_of(kLed + table);
  ASSERT_NE(light.led()->led.table, nullptr);
  EXPECT_EQ(light.led()->led.table->in_x(), (std::vector<double>{1, 0.6, 0}));
  EXPECT_EQ(light.led()->led.exponent, 0.0);
  EXPECT_EQ(light.led()->exponent_std, default_uncertainty::kLedExponent);
  EXPECT_THAT(light_refused(kLed + table + ", exponent: 1"),
              HasSubstr("hall.exponent: is given twice"));
}

// The picture is not opened before it is needed.
TEST(RigLightReader, Environment) {
  const SceneLight light = light_of(
      "type: environment, image: sky.hdr, projection: mirror_ball, radiance_W_per_mm2_sr: [1, 2, "
      "3], radiance_relative_std: 0.05");
  EXPECT_EQ(light.files, std::vector<std::string>{"a/sky.hdr"});
  const auto* sky = std::get_if<DistantLight>(&light.kind);
  ASSERT_NE(sky, nullptr);
  EXPECT_EQ(sky->radiance_W_per_mm2_sr[2], 3.0);
  EXPECT_EQ(sky->radiance_relative_std, 0.05);
  EXPECT_THAT(refusal_of([&] { sky->probe(); }),
              HasSubstr("a/rig.yaml:1: lights.hall.image: a/sky.hdr"));
  const std::string sky_fields = "type: environment, image: sky.hdr, projection: ";
  EXPECT_THAT(light_refused(sky_fields + "fisheye"),
              HasSubstr("expected equirectangular, angular_map or mirror_ball, got fisheye"));
  EXPECT_THAT(light_refused(sky_fields + "angular_map, forward: [0, 0, 1]"),
              HasSubstr("forward and up are parallel"));
  EXPECT_THAT(light_refused(sky_fields + "angular_map, radiance_W_per_mm2_sr: [0, 0, 0]"),
              HasSubstr("expected light in at least one channel"));
  EXPECT_THAT(light_refused("type: environment, projection: angular_map"),
              HasSubstr("hall.image: is missing"));
}

// A probe of 2 x 1 pixels: the picture of the file is the environment.
TEST(RigLightReader, EnvironmentReadsItsPicture) {
  const TemporaryFolder folder;
  write_file(folder / "sky.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n") +
                                     std::string("\x80\x40\x20\x81\x80\x40\x20\x82", 8));
  const SceneLight light = light_of(
      "type: environment, image: sky.hdr, projection: equirectangular", folder / "rig.yaml");
  EXPECT_EQ(light.files, std::vector<std::string>{folder / "sky.hdr"});
  EXPECT_EQ(refusal_of([&] { std::get<DistantLight>(light.kind).probe(); }), "");
}

TEST(RigLightReader, Ambient) {
  const SceneLight known = light_of(
      "type: ambient, radiance_W_per_mm2_sr: [1e-7, 2e-7, 3e-7], radiance_std_W_per_mm2_sr: [0, "
      "1e-8, 2e-8]");
  const auto* ambient = std::get_if<AmbientLight>(&known.kind);
  ASSERT_NE(ambient, nullptr);
  EXPECT_EQ(ambient->radiance_W_per_mm2_sr[1], 2e-7);
  EXPECT_EQ(ambient->radiance_std_W_per_mm2_sr[0], 0.0);
  EXPECT_EQ(ambient->radiance_std_W_per_mm2_sr[2], 2e-8);
  const SceneLight free = light_of("type: ambient, radiance_std_W_per_mm2_sr: free");
  EXPECT_EQ(std::get<AmbientLight>(free.kind).radiance_W_per_mm2_sr.maxCoeff(), 0.0);
  EXPECT_TRUE(std::isinf(std::get<AmbientLight>(free.kind).radiance_std_W_per_mm2_sr.minCoeff()));
  EXPECT_THAT(light_refused("type: ambient, radiance_std_W_per_mm2_sr: fixed"),
              HasSubstr("expected three numbers (R, G, B) or free, got fixed"));
  EXPECT_THAT(light_refused("type: ambient"), HasSubstr("radiance_std_W_per_mm2_sr: is missing"));
}

TEST(RigLightReader, NamesWhatIsWrong) {
  EXPECT_THAT(light_refused("type: laser"),
              HasSubstr("hall.type: expected led, environment or ambient, got laser"));
  EXPECT_THAT(light_refused("position_mm: [0, 0, 1]"), HasSubstr("hall.type: is missing"));
  EXPECT_THAT(light_refused(kLed + ", image: sky.hdr"), HasSubstr("hall.image: unknown key"));
  EXPECT_THAT(light_refused("type: led, position_mm: [0, 0, 1], axis: [0, 0, -1], "
                            "intensity_W_per_sr: [0, 0, 0]"),
              HasSubstr("expected light in at least one channel"));
  EXPECT_THAT(light_refused(kLed + ", calibration: led.yaml"),
              HasSubstr("position_mm: is given twice"));
  EXPECT_THAT(light_refused("type: led, calibration: gone.yaml"),
              HasSubstr("hall.calibration: there is no file"));
}

}  // namespace
}  // namespace scattermeter::apps
