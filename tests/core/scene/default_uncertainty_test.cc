#include "core/scene/default_uncertainty.h"

#include <numbers>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(DefaultUncertainty, FillsInWhatIsNotStated) {
  Scene scene;
  scene.camera.intrinsics = {640, 480, 700, 700, 320, 240, {}};
  scene.objects.resize(2);
  scene.objects[1].eta_std = 0.002;
  scene.lights.resize(2);
  scene.lights[0].kind = LedLight{};
  LedLight calibrated;
  calibrated.calibrated.emplace();
  scene.lights[1].kind = calibrated;
  default_uncertainty::take_where_none(scene);
  EXPECT_EQ(scene.objects[0].eta_std, default_uncertainty::kEta);
  EXPECT_EQ(scene.objects[1].eta_std, 0.002);
  EXPECT_EQ(scene.objects[0].gamma_std, default_uncertainty::kGamma);
  EXPECT_EQ(scene.objects[0].position_std_mm, default_uncertainty::kObjectPosition_mm);
  EXPECT_EQ(scene.objects[0].scale_relative_std, default_uncertainty::kMeshScale);
  EXPECT_EQ(scene.objects[0].edge_std_mm, default_uncertainty::kEdge_mm);
  const LedLight& led = *scene.lights[0].led();
  EXPECT_EQ(led.position_std_mm, default_uncertainty::kLedPosition_mm);
  EXPECT_DOUBLE_EQ(led.axis_std_rad * 180.0 / std::numbers::pi, default_uncertainty::kLedAxis_deg);
  EXPECT_EQ(led.exponent_std, default_uncertainty::kLedExponent);
  EXPECT_EQ(led.intensity_relative_std, default_uncertainty::kLedIntensity);
  EXPECT_EQ(scene.even_light_share_std, default_uncertainty::kEvenLight);
  EXPECT_EQ(scene.shot_shift_std_px, default_uncertainty::kShotShift_px);
  EXPECT_EQ(scene.camera.lens_root.cols(), 5);
  // A calibration states its own.
  EXPECT_EQ(scene.lights[1].led()->position_std_mm, 0.0);
}

}  // namespace
}  // namespace scattermeter
