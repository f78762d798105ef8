#include "apps/rig/rig_camera_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/rig/radiance_file.h"
#include "capture/sensor/radiance_calibration.h"
#include "core/scene/default_uncertainty.h"
#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

const std::string kCamera =
    "image_size_px: [484, 324]\n"
    "intrinsics: {fx_px: 1229.5, fy_px: 1230.5, cx_px: 241.8, cy_px: 161.2}\n";

class RigCameraReader : public ::testing::Test {
 protected:
  Rig camera(const std::string& text, bool with_radiance = true) const {
    Rig rig;
    rig.path = folder_ / "rig.yaml";
    read_camera(yaml_text(text), with_radiance, rig);
    return rig;
  }
  std::string refused(const std::string& text) const {
    return refusal_of([&] { camera(text); });
  }
  TemporaryFolder folder_;
};

TEST_F(RigCameraReader, ReadsEveryField) {
  const Rig rig = camera(
      "model: NIKON D80\nimage_size_px: [484, 324]\n"
      "intrinsics: {fx_px: 1229.5, fy_px: 1230.5, cx_px: 241.8, cy_px: 161.2, distortion: [-0.1, "
      "0.05, 0, 0.001]}\n"
      "responsivity_counts_mm2_sr_per_W_s: [2.4e10, 2.9e10, 2.1e10]\n"
      "responsivity_relative_std: 0.01\n"
      "sensor: {gain_e_per_count: 6, read_noise_counts: 1.2, cfa: GRBG, black_counts: [1, 2, 3, "
      "4], "
      "white_counts: 4000, tone_curve: nef_lossy}\n"
      "exposure_s: 0.05\niso: 200\nf_number: 5.6\n");
  const SceneCamera& c = rig.scene.camera;
  EXPECT_EQ(c.model, "NIKON D80");
  EXPECT_EQ(c.intrinsics.width_px, 484);
  EXPECT_EQ(c.intrinsics.height_px, 324);
  EXPECT_EQ(c.intrinsics.fx_px, 1229.5);
  EXPECT_EQ(c.intrinsics.fy_px, 1230.5);
  EXPECT_EQ(c.intrinsics.cx_px, 241.8);
  EXPECT_EQ(c.intrinsics.cy_px, 161.2);
  EXPECT_EQ(c.intrinsics.distortion, (std::vector<double>{-0.1, 0.05, 0, 0.001}));
  EXPECT_EQ(c.responsivity, (std::array<double, 3>{2.4e10, 2.9e10, 2.1e10}));
  EXPECT_EQ(c.responsivity_relative_std, 0.01);
  EXPECT_EQ(c.sensor.noise.gain_e_per_count, 6.0);
  EXPECT_EQ(c.sensor.noise.read_noise_counts, 1.2);
  EXPECT_EQ(c.sensor.cfa, cfa_pattern_from_name("GRBG"));
  EXPECT_EQ(c.sensor.black_counts, (std::array<int, 4>{1, 2, 3, 4}));
  EXPECT_EQ(c.sensor.white_counts, 4000);
  EXPECT_TRUE(c.sensor.nef_lossy_curve);
  EXPECT_EQ(c.exposure_s, 0.05);
  EXPECT_EQ(c.iso, 200);
  EXPECT_EQ(c.f_number, 5.6);
  EXPECT_EQ(rig.intrinsics_path, "");
  EXPECT_EQ(rig.lens, nullptr);
}

TEST_F(RigCameraReader, TheLeast) {
  const Rig rig = camera(kCamera);
  EXPECT_EQ(rig.scene.camera.model, "");
  EXPECT_FALSE(rig.scene.camera.responsivity || rig.scene.camera.exposure_s);
  EXPECT_TRUE(rig.scene.camera.intrinsics.distortion.empty());
  EXPECT_EQ(rig.decoding.radiance, nullptr);
  EXPECT_EQ(camera(kCamera + "sensor: {black_counts: 50}\n").scene.camera.sensor.black_counts,
            (std::array<int, 4>{50, 50, 50, 50}));
}

TEST_F(RigCameraReader, LensIsUncertainUnlessStatedExact) {
  EXPECT_EQ(camera(kCamera).scene.camera.lens_root.cols(), 5);
  const auto stated = camera(kCamera + "intrinsics_std: {focal_length_relative: 0.01, k1: 0}\n");
  const LensRoot root = stated.scene.camera.lens_root;
  EXPECT_EQ(root.cols(), 4);
  EXPECT_DOUBLE_EQ(root(0, 0), 0.01 * stated.scene.camera.intrinsics.fx_px);
  EXPECT_EQ(camera(kCamera + "intrinsics_std: {focal_length_relative: 0, aspect_relative: 0, "
                             "centre_px: 0, k1: 0}\n")
                .scene.camera.lens_root.cols(),
            0);
  EXPECT_THAT(refused(kCamera + "intrinsics_std: {focal: 0}\n"), HasSubstr("focal"));
  EXPECT_THAT(refused(kCamera + "intrinsics_std: {k1: -1}\n"), HasSubstr("intrinsics_std.k1"));
}

// Its responsivity is the camera's; it belongs to frames of its size.
TEST_F(RigCameraReader, RadianceCalibration) {
  capture::RadianceCalibration made;
  made.correction.width_px = 484;
  made.correction.height_px = 324;
  made.correction.vignetting = vignetting_of_frame(484, 324);
  made.correction.noise.fill({6.0, 1.2});
  made.correction.glare_std.fill(0.001);
  made.responsivity = {1e10, 2e10, 3e10};
  made.responsivity_relative_std = 0.02;
  write_file(folder_ / "radiance.yaml", radiance_file_text(made));
  const std::string text = kCamera + "radiance: radiance.yaml\n";
  const Rig rig = camera(text);
  ASSERT_NE(rig.decoding.radiance, nullptr);
  EXPECT_EQ(rig.decoding.radiance_path, folder_ / "radiance.yaml");
  EXPECT_EQ(rig.scene.camera.responsivity, (std::array<double, 3>{1e10, 2e10, 3e10}));
  EXPECT_EQ(rig.scene.camera.responsivity_relative_std, 0.02);
  EXPECT_EQ(rig.scene.camera.glare_std[1], 0.001);
  EXPECT_EQ(camera(text, false).decoding.radiance, nullptr);
  EXPECT_EQ(rig.scene.camera.vignetting_std, 0.0);
  EXPECT_EQ(camera(kCamera).scene.camera.vignetting_std, default_uncertainty::kVignetting);
  EXPECT_EQ(camera(kCamera + "vignetting_std: 0.03\n").scene.camera.vignetting_std, 0.03);
  EXPECT_THAT(refused(text + "vignetting_std: 0.03\n"),
              HasSubstr("vignetting_std: the file of camera.radiance corrects the vignetting"));
  EXPECT_EQ(rig.scene.camera.non_linearity_std, 0.0);
  EXPECT_EQ(camera(kCamera).scene.camera.non_linearity_std, default_uncertainty::kNonLinearity);
  EXPECT_EQ(camera(kCamera + "non_linearity_std: 0.01\n").scene.camera.non_linearity_std, 0.01);
  EXPECT_THAT(refused(text + "non_linearity_std: 0.01\n"),
              HasSubstr("non_linearity_std: the file of camera.radiance corrects the response"));
  EXPECT_THAT(refused(text + "responsivity_counts_mm2_sr_per_W_s: [1, 1, 1]\n"),
              HasSubstr("radiance: contains a responsivity"));
  made.correction.width_px = 480;
  write_file(folder_ / "radiance.yaml", radiance_file_text(made));
  EXPECT_THAT(refused(text), HasSubstr("the calibration is of 480 x 324 samples"));
}

TEST_F(RigCameraReader, NamesWhatIsWrong) {
  EXPECT_THAT(refused("image_size_px: [484, 324]\nintrinsics: gone.yaml\n"),
              HasSubstr("intrinsics: there is no file " + (folder_ / "gone.yaml")));
  EXPECT_THAT(refused("image_size_px: [484, 324]\nintrinsics: {fx_px: 1, fy_px: 1, cx_px: 2000, "
                      "cy_px: 1}\n"),
              HasSubstr("intrinsics"));
  EXPECT_THAT(refused("image_size_px: [484, 324]\nintrinsics: {fx_px: 1, fy_px: 1, cx_px: 1, "
                      "cy_px: 1, distortion: [0.1, 0.1]}\n"),
              HasSubstr("distortion: expected 0, 4, 5 or 8 terms"));
  EXPECT_THAT(refused(kCamera + "responsivity_relative_std: 0.1\n"),
              HasSubstr("is given without responsivity"));
  EXPECT_THAT(refused(kCamera + "sensor: {cfa: RGB}\n"), HasSubstr("sensor.cfa: expected RGGB"));
  EXPECT_THAT(refused(kCamera + "sensor: {black_counts: 100, white_counts: 100}\n"),
              HasSubstr("expected black below white_counts"));
  EXPECT_THAT(refused(kCamera + "sensor: {tone_curve: log}\n"), HasSubstr("linear or nef_lossy"));
  EXPECT_THAT(refused(kCamera + "iso: 0\n"), HasSubstr("iso"));
}

TEST_F(RigCameraReader, FocalLengthInMillimetres) {
  EXPECT_THAT(refused("image_size_px: [3872, 2592]\n"
                      "intrinsics: {fx_px: 60, fy_px: 60, cx_px: 1935, cy_px: 1295}\n"),
              HasSubstr("intrinsics: fx_px 60 sees 176 degrees across the 3872 px"));
  EXPECT_EQ(camera("image_size_px: [3872, 2592]\n"
                   "intrinsics: {fx_px: 400, fy_px: 400, cx_px: 1935, cy_px: 1295}\n")
                .scene.camera.intrinsics.fx_px,
            400.0);
}

}  // namespace
}  // namespace scattermeter::apps
