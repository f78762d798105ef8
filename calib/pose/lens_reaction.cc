#include "calib/pose/lens_reaction.h"

#include <Eigen/Geometry>

#include "calib/pose/silhouette_pose.h"
#include "core/camera/lens_parameters.h"
#include "core/camera/pose_shift.h"

namespace scattermeter::calib {
PosePerLens combined_per_lens_parameter(const Silhouette& silhouette,
                                        const CameraIntrinsics& intrinsics, const PoseResult& prior,
                                        const LensParameters& steps) {
  const auto combined = [&](Eigen::Index parameter, double by) {
    LensParameters lens = lens_parameters(intrinsics);
    lens[parameter] += by;
    PoseResult other = prior;
    other.camera_from_world =
        shifted_pose(prior.camera_from_world, by * prior.per_lens_parameter.col(parameter));
    return fit_with_pose(silhouette, intrinsics_of(lens, intrinsics.width_px, intrinsics.height_px),
                         other)
        .camera_from_world;
  };
  PosePerLens out = PosePerLens::Zero();
  for (Eigen::Index k = 0; k < kLensParameters; ++k) {
    if (!(steps[k] > 0.0)) continue;
    const Rigid3d up = combined(k, steps[k]);
    const Rigid3d down = combined(k, -steps[k]);
    const Eigen::AngleAxisd turn(up.rotation * down.rotation.conjugate());
    out.col(k) << turn.angle() * turn.axis(), up.translation_mm - down.translation_mm;
    out.col(k) /= 2.0 * steps[k];
  }
  return out;
}

}  // namespace scattermeter::calib
