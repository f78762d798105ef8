#include "apps/instrument/focus.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "calib/pose/edge_points.h"
#include "calib/pose/silhouette_check.h"

namespace scattermeter::apps {
namespace {

// Of (blur / mean free path)^2, the relative error of sigma_s' by blur: 0.2 to 1.7 for cube and
// pyramid, faint to dense (`bench deviations`, "out of focus"). That of sigma_a, which is too large
// where sigma_s' is too small, is as many deviations.
constexpr double kErrorByBlur = 2.0;
constexpr double kMostError = 0.03;
// What the fit to a sharp edge may yield, px; subtracted in squares.
constexpr double kSharp_px = 0.3;
// Beyond this, a shot that is refused is told to be blurred.
constexpr double kBlurred_px = 0.8;

// Size of a pixel on the object.
double px_mm(const ObjectScene& object, const PoseResult& pose, double fx_px) {
  return (pose.camera_from_world * object.box.center_mm()).z() / fx_px;
}

}  // namespace

double edge_blur_mm(const Rig& rig, const ObjectScenes& objects, const SceneShot& shot,
                    const capture::RawFrame& frame, const PoseResult& pose) {
  const ObjectScene& object = objects.at(shot.object);
  if (object.is_round) return 0.0;
  const CameraIntrinsics& lens = rig.scene.camera.intrinsics;
  const calib::EdgeShot edges =
      calib::edge_shot(rig.scene, rig.pose, objects, shot, frame, pose.camera_from_world, {});
  const double seen_px = calib::edge_blur_px(edges, lens, pose.camera_from_world);
  const double blur_px = std::sqrt(std::max(0.0, seen_px * seen_px - kSharp_px * kSharp_px));
  return blur_px * px_mm(object, pose, lens.fx_px);
}

void widen_by_blur(std::span<const ObservedShot> shots, double fx_px,
                   std::vector<ChannelResult>& results) {
  for (ChannelResult& r : results) {
    const ObservedShot* most = nullptr;
    for (const ObservedShot& shot : shots) {
      if (shot.stated->material != r.material) continue;
      if (most == nullptr || shot.edge_blur_mm > most->edge_blur_mm) most = &shot;
    }
    if (most == nullptr || !(most->edge_blur_mm > 0.0)) continue;
    const double blur_mm = most->edge_blur_mm;
    if (r.refused()) {
      // Its mean free path is not to be trusted. What else is wrong may come first.
      const double blur_px = blur_mm / px_mm(*most->seen->object, most->pose, fx_px);
      if (blur_px > kBlurred_px) {
        r.estimate.reasons.push_back(
            fmt::format("the edges are blurred by {:.2g} px (standard deviation): out of focus, or "
                        "moved during the exposure; focus on the object",
                        blur_px));
      }
      continue;
    }
    Quantity& s = r.estimate.sigma_s_prime_per_mm;
    const double mfp_mm = 1.0 / (s.value + r.estimate.sigma_a_per_mm.value);
    const double relative = kErrorByBlur * blur_mm * blur_mm / (mfp_mm * mfp_mm);
    if (!(relative > 0.0) || !(s.std > 0.0)) continue;
    const double by_s = relative * s.value;
    const double by_a = by_s / s.std * r.estimate.sigma_a_per_mm.std;
    widen({"focus", by_s, by_a}, -by_s * by_a, r.estimate);
    if (!(relative > kMostError)) continue;
    r.estimate.reasons.push_back(fmt::format(
        "out of focus, or moved during the exposure: edges are blurred by {:.2g} mm (standard "
        "deviation), not small against the mean free path, {:.2g} mm; focus on the object, or move "
        "the camera closer",
        blur_mm, mfp_mm));
  }
}

}  // namespace scattermeter::apps
