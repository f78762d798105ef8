// What a pose and a ray become where the lens is another than was thought.
#pragma once

#include <Eigen/Core>

#include "calib/camera_model.h"
#include "calib/lens_parameters.h"
#include "calib/pose.h"
#include "calib/silhouette.h"

namespace scattermeter::calib {

// d(ray)/d(parameter) of the ray (X / Z, Y / Z) that falls on a fixed pixel: the pixel stays, so
// J_ray d(ray) + shift_per_lens_parameter() d(parameter) = 0. Per px and per unit as there. NaN
// outside the domain of Distortion.
Eigen::Matrix<double, 2, kLensParameters> ray_per_lens_parameter(const CameraIntrinsics& intrinsics,
                                                                 const Eigen::Vector2d& ray);

// PoseResult::per_lens_parameter of combine(silhouette, intrinsics, prior): both of its sources are
// read anew through the other lens, by central differences of the given steps (one a parameter; 0:
// that column is 0). Found edges stay where they are in the image. Two least squares a step.
PosePerLens combined_per_lens_parameter(const Silhouette& silhouette,
                                        const CameraIntrinsics& intrinsics, const PoseResult& prior,
                                        const LensParameters& steps);

}  // namespace scattermeter::calib
