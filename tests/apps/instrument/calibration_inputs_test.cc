#include "apps/instrument/calibration_inputs.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/sensor/radiance_calibration.h"
#include "tests/fixtures/apps/board_rig.h"
#include "tests/fixtures/apps/led_rig.h"
#include "tests/fixtures/apps/radiance_rig.h"
#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class LedInputs : public ::testing::Test {
 protected:
  LedInputs() {
    write_file(folder_ / "rig.yaml", led_rig_yaml());
    rig_ = read_rig(folder_ / "rig.yaml");
  }
  TemporaryFolder folder_;
  Rig rig_;
};

TEST_F(LedInputs, AreTheRigs) {
  LedLight& led = *rig_.scene.lights[0].led();
  led.position_std_mm = 0.1;
  led.exponent_std = 0.2;
  led.intensity_relative_std = 0.3;
  SceneLight ambient;
  ambient.kind = AmbientLight{};
  rig_.scene.lights.push_back(ambient);
  const calib::LedCalibrationInput input = led_calibration_input(rig_);
  EXPECT_EQ(input.shots.shots.size(), 3U);
  EXPECT_EQ(input.shots.spheres.size(), 4U);
  ASSERT_EQ(input.leds.size(), 1U);  // the other light is no LED
  EXPECT_EQ(input.led("led1").led.position_mm, Eigen::Vector3d(30, -60, 80));
  EXPECT_EQ(input.led("led1").position_std_mm, 0.1);
  EXPECT_EQ(input.led("led1").exponent_std, 0.2);
  EXPECT_EQ(input.led("led1").power_relative_std, 0.3);
  EXPECT_FALSE(input.led("led1").calibrated.has_value());
  EXPECT_EQ(input.intrinsics.fx_px, 1229.5);
  EXPECT_EQ(input.responsivity_counts_mm2_sr_per_W_s,
            (std::array<double, 3>{2.4e10, 2.9e10, 2.1e10}));
  EXPECT_EQ(input.noise.gain_e_per_count, 6.0);
  EXPECT_EQ(input.noise.read_noise_counts, 1.2);
  EXPECT_FALSE(input.correction.has_value());
  // By the points of the rig, whatever the frame shows.
  EXPECT_TRUE(input.pose.is_shared);
  const PoseResult pose = input.pose.estimate({}, "any.dng");
  EXPECT_EQ(pose.status, PoseStatus::kOk);
  const Eigen::Vector3d center = inverse(pose.camera_from_world).translation_mm;
  EXPECT_NEAR((center - Eigen::Vector3d(0, -100, 150)).norm(), 0.0, 0.01);
}

TEST_F(LedInputs, WithARadianceCalibration) {
  auto radiance = std::make_shared<capture::RadianceCalibration>();
  radiance->correction.iso = 800;
  rig_.decoding.radiance = radiance;
  const calib::LedCalibrationInput input = led_calibration_input(rig_);
  ASSERT_TRUE(input.correction.has_value());
  EXPECT_EQ(input.correction->iso, 800.0);
}

TEST_F(LedInputs, ABoardGivesEachFrameItsPose) {
  rig_.pose.charuco = calib::CharucoBoard{};
  EXPECT_FALSE(led_calibration_input(rig_).pose.is_shared);
}

TEST_F(LedInputs, FramesAreThoseOfTheFolder) {
  std::filesystem::create_directories(folder_ / "shots");
  const calib::LedFrames frames = led_frames_in(rig_, folder_ / "shots");
  EXPECT_THAT(refusal_of([&] { frames(1); }), ::testing::AllOf(HasSubstr("low_led1.dng is missing"),
                                                               HasSubstr(folder_ / "rig.yaml:")));
  rig_.calibration.led.reset();
  EXPECT_THAT(refusal_of([&] { led_calibration_input(rig_); }),
              HasSubstr("calibration.led: is missing"));
}

TEST(RadianceInputs, AreTheRigs) {
  Rig rig = radiance_rig();
  rig.scene.lights[0].led()->intensity_relative_std = 0.01;
  const calib::RadianceCalibrationInput input = radiance_calibration_input(rig);
  EXPECT_EQ(input.shots.dark.size(), 6U);
  EXPECT_EQ(input.shots.flats.size(), 24U);
  ASSERT_TRUE(input.white_led.has_value());
  EXPECT_EQ(input.white_led->name, "led1");
  EXPECT_EQ(input.white_led->power_relative_std, 0.01);
  EXPECT_EQ(input.intrinsics.width_px, 120);
  EXPECT_TRUE(input.pose.is_shared);
  rig.calibration.radiance->white.reset();
  EXPECT_FALSE(radiance_calibration_input(rig).white_led.has_value());
  const calib::RadianceShot gone{"gone.dng", {}, 1, 0};
  EXPECT_THAT(refusal_of([&] { radiance_frames_in(rig, "/nowhere")(gone); }),
              HasSubstr("/nowhere/gone.dng"));
  rig.calibration.radiance.reset();
  EXPECT_THAT(refusal_of([&] { radiance_calibration_input(rig); }),
              HasSubstr("rig.yaml: calibration.radiance: is missing"));
}

TEST(CameraInputs, AreTheRigsAndTheFolders) {
  const BoardRig rig(kCharuco, 3, 3);
  for (const char* name : {"board_0.dng", "board_1.dng", "board_2.dng"}) {
    write_file(rig.shots() + "/" + name, std::string("x"));
  }
  const calib::CalibrateCameraOptions options = camera_calibration_input(rig.rig(), rig.shots());
  EXPECT_THAT(options.shots, ElementsAre(rig.shots() + "/board_0.dng", rig.shots() + "/board_1.dng",
                                         rig.shots() + "/board_2.dng"));
  EXPECT_EQ(options.board.kind, calib::BoardKind::kCharuco);
  EXPECT_EQ(options.board.square_mm, 30.0);
  EXPECT_EQ(options.camera, "NIKON D80");
  EXPECT_EQ(options.width_px, 484);
  EXPECT_EQ(options.height_px, 324);
  EXPECT_EQ(options.max_megapixels, 400.0);
  EXPECT_FALSE(options.model.has_value());
  std::filesystem::remove(rig.shots() + "/board_0.dng");
  std::filesystem::remove(rig.shots() + "/board_2.dng");
  EXPECT_THAT(
      refusal_of([&] { camera_calibration_input(rig.rig(), rig.shots()); }),
      HasSubstr("listed, but not in the folder " + rig.shots() + ": board_0.dng, board_2.dng"));
  EXPECT_THAT(refusal_of([&] { camera_calibration_input(rig.rig(), rig / "gone"); }),
              HasSubstr("gone: is not the folder of the rig's shots"));
}

}  // namespace
}  // namespace scattermeter::apps
