#include "apps/rig/rig_camera_reader.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

const std::string kCamera =
    "image_size_px: [400, 300]\n"
    "intrinsics: {fx_px: 1000, fy_px: 1001, cx_px: 199.5, cy_px: 149.5}\n";

SceneCamera camera_of(const std::string& more, const std::string& text = kCamera) {
  Rig rig;
  rig.path = "rig.yaml";
  read_camera(YamlField(YAML::Load(text + more), "rig.yaml", "camera"), true, rig);
  return rig.scene.camera;
}

std::string camera_error(const std::string& more, const std::string& text = kCamera) {
  try {
    camera_of(more, text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(RigCameraReader, HasDefaults) {
  const SceneCamera camera = camera_of("");
  EXPECT_EQ(camera.intrinsics.width_px, 400);
  EXPECT_EQ(camera.intrinsics.height_px, 300);
  EXPECT_EQ(camera.intrinsics.fy_px, 1001.0);
  EXPECT_TRUE(camera.intrinsics.distortion.empty());
  EXPECT_EQ(camera.model, "");
  EXPECT_FALSE(camera.responsivity);
  EXPECT_FALSE(camera.exposure_s);
  EXPECT_EQ(camera.iso, 100);
  EXPECT_EQ(camera.f_number, 8.0);
  EXPECT_EQ(camera.sensor.white_counts, 4095);
}

TEST(RigCameraReader, ReadsEveryKey) {
  const SceneCamera camera = camera_of(
      "model: X\nresponsivity_counts_mm2_sr_per_W_s: [1, 2, 3]\nresponsivity_relative_std: 0.5\n"
      "exposure_s: 0.25\niso: 200\nf_number: 4\n"
      "sensor: {gain_e_per_count: 3, read_noise_counts: 2, cfa: GBRG, black_counts: [1, 2, 3, 4], "
      "white_counts: 4000, tone_curve: nef_lossy}\n");
  EXPECT_EQ(camera.model, "X");
  EXPECT_EQ(camera.responsivity->at(2), 3.0);
  EXPECT_EQ(camera.responsivity_relative_std, 0.5);
  EXPECT_EQ(camera.exposure_s, 0.25);
  EXPECT_EQ(camera.iso, 200);
  EXPECT_EQ(camera.f_number, 4.0);
  EXPECT_EQ(camera.sensor.noise.gain_e_per_count, 3.0);
  EXPECT_EQ(camera.sensor.noise.read_noise_counts, 2.0);
  EXPECT_EQ(cfa_pattern_name(camera.sensor.cfa), "GBRG");
  EXPECT_EQ(camera.sensor.black_counts, (std::array<int, 4>{1, 2, 3, 4}));
  EXPECT_EQ(camera.sensor.white_counts, 4000);
  EXPECT_TRUE(camera.sensor.nef_lossy_curve);
}

TEST(RigCameraReader, NamesTheField) {
  EXPECT_THAT(camera_error("responsivity_relative_std: 0.1\n"),
              HasSubstr("camera.responsivity_relative_std: is given without responsivity"));
  EXPECT_THAT(camera_error("sensor: {black_counts: 100, white_counts: 100}\n"),
              HasSubstr("camera.sensor.black_counts: expected black below white_counts"));
  EXPECT_THAT(camera_error("sensor: {cfa: RGBG}\n"),
              HasSubstr("expected RGGB, GRBG, GBRG or BGGR"));
  EXPECT_THAT(camera_error("sensor: {tone_curve: log}\n"),
              HasSubstr("expected linear or nef_lossy"));
  EXPECT_THAT(camera_error("",
                           "image_size_px: [400, 1]\nintrinsics: {fx_px: 1, fy_px: 1, cx_px: 0, "
                           "cy_px: 0}\n"),
              HasSubstr("camera.image_size_px[1]"));
  EXPECT_THAT(camera_error("",
                           "image_size_px: [400, 300]\nintrinsics: {fx_px: 1000, fy_px: 1000, "
                           "cx_px: 0, cy_px: 0, distortion: [1, 2, 3]}\n"),
              HasSubstr("camera.intrinsics.distortion: expected 0, 4, 5 or 8 terms"));
  EXPECT_THAT(camera_error("radiance: /nowhere/radiance.yaml\n"),
              HasSubstr("/nowhere/radiance.yaml"));
}

}  // namespace
}  // namespace scattermeter::apps
