// Camera pose from known geometry.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/camera/camera_model.h"
#include "core/camera/camera_pose.h"

namespace scattermeter::calib {

struct PoseOptions {
  double inlier_px = 2.0;  // a pair with a larger reprojection error is an outlier, px. At least
                           // three times the noise: cutting into it makes the rest look better
  double confidence = 0.9999;  // of the robust search, in (0, 1)
  double point_std_px = 0.3;  // assumed standard deviation of each coordinate of image_px; a larger
                              // one found in the residuals takes its place, px
  // A second pose explains the points as well when it is less than 10^4 times less likely than the
  // first (given the noise), or its rms exceeds the first's by less than this factor. The factor
  // stands for what is no independent noise: a lens or a board that departs from its model. >= 1.
  double ambiguity_ratio = 1.2;
  void Check() const;  // std::invalid_argument naming the field
};

// Robust search (poses from three points each, scored on all), nonlinear least squares over the
// inliers, in turns until the inliers stay; covariance from the Jacobian there. Deterministic.
//
// What is claimed of outliers: with n pairs, up to (n - 1) / 2 gross ones are rejected as long as
// four pairs remain. Four pairs leave two degrees of freedom: a gross error in one is noticed (no
// pose fits), not found. Errors of a few inlier_px among four to six pairs may be fitted rather
// than rejected; they show in noise_std_px and so in the covariance.
//
// Never throws on degenerate layouts: the status says it. Throws std::invalid_argument on
// coordinates that are not finite, on intrinsics_problem() and on options out of range.
PoseResult estimate_pose(const CameraIntrinsics& intrinsics, const std::vector<PointPair>& pairs,
                         const PoseOptions& options = {});

}  // namespace scattermeter::calib
