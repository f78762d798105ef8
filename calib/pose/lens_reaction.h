// Response of a pose to changes of the lens parameters.
#pragma once

#include <Eigen/Core>

#include "calib/pose/pose.h"
#include "calib/pose/silhouette.h"
#include "core/camera/camera_model.h"
#include "core/camera/lens_parameters.h"

namespace scattermeter::calib {

// PoseResult::per_lens_parameter of combine(silhouette, intrinsics, prior), by central differences
// with the given steps (one for each parameter; 0: that column is 0). Silhouette and prior are both
// evaluated again with the changed lens, while the edges located in the image remain unchanged. Two
// least squares for each step.
PosePerLens combined_per_lens_parameter(const Silhouette& silhouette,
                                        const CameraIntrinsics& intrinsics, const PoseResult& prior,
                                        const LensParameters& steps);

}  // namespace scattermeter::calib
