// What a pose and a ray become where the lens is another than was thought.
#pragma once

#include <Eigen/Core>

#include "calib/pose/pose.h"
#include "calib/pose/silhouette.h"
#include "core/camera/camera_model.h"
#include "core/camera/lens_parameters.h"

namespace scattermeter::calib {

// PoseResult::per_lens_parameter of combine(silhouette, intrinsics, prior): both of its sources are
// read anew through the other lens, by central differences of the given steps (one a parameter; 0:
// that column is 0). Found edges stay where they are in the image. Two least squares a step.
PosePerLens combined_per_lens_parameter(const Silhouette& silhouette,
                                        const CameraIntrinsics& intrinsics, const PoseResult& prior,
                                        const LensParameters& steps);

}  // namespace scattermeter::calib
