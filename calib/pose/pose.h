// Estimation of the camera pose from points with known positions.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/camera/camera_model.h"
#include "core/camera/camera_pose.h"

namespace scattermeter::calib {

struct PoseOptions {
  double inlier_px = 2.0;  // a pair with a larger reprojection error is an outlier, px. At least
                           // three times the noise: less would reject inliers and understate it
  double confidence = 0.9999;  // of the robust search, in (0, 1)
  double point_std_px = 0.3;  // assumed standard deviation of each coordinate of image_px; replaced
                              // by that of the residuals if larger, px
  // A second pose makes the result ambiguous if it is less than 10^4 times less likely than the
  // first (given the noise), or if its rms exceeds that of the first by less than this factor,
  // which allows for errors other than independent noise: a lens or a board that departs from its
  // model. >= 1.
  double ambiguity_ratio = 1.2;
  void Check() const;  // std::invalid_argument naming the field
};

// A robust search (poses from three points each, scored on all), then nonlinear least squares over
// the inliers, repeated until the set of inliers no longer changes; the covariance is derived from
// the Jacobian at the solution. Deterministic.
//
// Outliers: with n pairs, up to (n - 1) / 2 gross outliers are rejected as long as four pairs
// remain. Four pairs leave two degrees of freedom: a gross error in one of them is detected (no
// pose fits) but not located. Errors of a few inlier_px among four to six pairs may be fitted
// rather than rejected; they increase noise_std_px and thus the covariance.
//
// Degenerate layouts are reported by the status, never by an exception. Throws
// std::invalid_argument for coordinates that are not finite, for intrinsics that
// intrinsics_problem() rejects and for options out of range.
PoseResult estimate_pose(const CameraIntrinsics& intrinsics, const std::vector<PointPair>& pairs,
                         const PoseOptions& options = {});

}  // namespace scattermeter::calib
