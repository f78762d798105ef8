#include "core/scene/default_uncertainty.h"

#include <numbers>

namespace scattermeter::default_uncertainty {

LensDeviations lens(const CameraIntrinsics& intrinsics) {
  return {kFocalLength, kPixelAspect, kPrincipalPoint * intrinsics.width_px, kDistortion};
}

void take_where_none(Scene& scene) {
  const auto take = [](double& std, double otherwise) {
    if (!(std > 0.0)) std = otherwise;
  };
  for (SceneObject& object : scene.objects) {
    take(object.eta_std, kEta);
    take(object.gamma_std, kGamma);
    take(object.position_std_mm, kObjectPosition_mm);
    take(object.scale_relative_std, kMeshScale);
    take(object.edge_std_mm, kEdge_mm);
    if (object.surface_alpha == 0.0) take(object.surface_alpha_std, kSurfaceAlpha);
  }
  for (SceneLight& light : scene.lights) {
    LedLight* led = light.led();
    if (led == nullptr || led->calibrated) continue;
    take(led->position_std_mm, kLedPosition_mm);
    take(led->axis_std_rad, kLedAxis_deg * std::numbers::pi / 180.0);
    take(led->exponent_std, kLedExponent);
    take(led->intensity_relative_std, kLedIntensity);
  }
  take(scene.even_light_share_std, kEvenLight);
  take(scene.shot_shift_std_px, kShotShift_px);
  SceneCamera& camera = scene.camera;
  take(camera.vignetting_std, kVignetting);
  take(camera.non_linearity_std, kNonLinearity);
  if (camera.lens_root.cols() == 0) {
    camera.lens_root = lens_root(camera.intrinsics, lens(camera.intrinsics));
  }
}

}  // namespace scattermeter::default_uncertainty
