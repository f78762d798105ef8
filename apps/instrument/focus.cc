#include "apps/instrument/focus.h"

#include <algorithm>
#include <optional>

#include <Eigen/Eigenvalues>
#include <fmt/core.h>

#include "apps/looks/closer_look.h"
#include "calib/pose/edge_points.h"
#include "calib/pose/limb_blur.h"
#include "calib/pose/silhouette_check.h"

namespace scattermeter::apps {
namespace {

// Of the mean free path. Cube and pyramid of 0.6 to 2.5 per mm, out of focus by up to 0.55 of it,
// are answered within their deviations (`bench deviations`, "out of focus").
constexpr double kMostBlur = 0.6;
// What the fit to a sharp edge may yield, px; subtracted in squares.
constexpr double kSharp_px = 0.3;
// Beyond this, a shot that is refused is told to be blurred.
constexpr double kBlurred_px = 0.8;

}  // namespace

EdgeBlur edge_blur(const Rig& rig, const ObjectScenes& objects, const SceneShot& shot,
                   const capture::RawFrame& frame, const PoseResult& pose) {
  const ObjectScene& object = objects.at(shot.object);
  const CameraIntrinsics& lens = rig.scene.camera.intrinsics;
  const calib::EdgeShot edges =
      calib::edge_shot(rig.scene, rig.pose, objects, shot, frame, pose.camera_from_world, {});
  const std::optional<Eigen::Matrix2d> seen_px2 =
      object.is_round ? calib::limb_blur_px2(edges, lens, pose.camera_from_world,
                                             object.stated->eta_int_over_ext)
                      : calib::edge_blur_px2(edges, lens, pose.camera_from_world);
  if (!seen_px2) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(*seen_px2);
  const Eigen::Vector2d beyond_px2 =
      (axes.eigenvalues().array() - kSharp_px * kSharp_px).cwiseMax(0.0);
  const double px_mm = 1.0 / px_per_mm(lens, object, pose);
  return {true, px_mm * px_mm * axes.eigenvectors() * beyond_px2.asDiagonal() *
                    axes.eigenvectors().transpose()};
}

void refuse_blurred(std::span<const ObservedShot> shots, double fx_px,
                    std::vector<ChannelResult>& results) {
  for (ChannelResult& r : results) {
    const ObservedShot* most = nullptr;
    double blur_mm = 0.0;
    for (const ObservedShot& shot : shots) {
      if (shot.stated->material != r.material || !shot.edge_blur) continue;
      const double own_mm = shot.edge_blur->largest_std_mm();
      if (!(own_mm > blur_mm)) continue;
      most = &shot;
      blur_mm = own_mm;
    }
    if (most == nullptr) continue;
    if (r.refused()) {
      // Its mean free path is not to be trusted. What else is wrong may come first.
      const double blur_px = blur_mm / most->px_mm(fx_px);
      if (blur_px > kBlurred_px) {
        r.estimate.reasons.push_back(
            fmt::format("the edges are blurred by {:.2g} px (standard deviation): out of focus, or "
                        "moved during the exposure; focus on the object",
                        blur_px));
      }
      continue;
    }
    const double mfp_mm =
        1.0 / (r.estimate.sigma_s_prime_per_mm.value + r.estimate.sigma_a_per_mm.value);
    if (!(blur_mm > kMostBlur * mfp_mm)) continue;
    r.estimate.reasons.push_back(fmt::format(
        "out of focus, or moved during the exposure: edges are blurred by {:.2g} mm (standard "
        "deviation), not small against the mean free path, {:.2g} mm; focus on the object, or move "
        "the camera closer",
        blur_mm, mfp_mm));
  }
}

}  // namespace scattermeter::apps
