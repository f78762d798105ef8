// A camera pose estimated from known points: value, covariance and the points' residuals.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/camera/lens_parameters.h"
#include "core/camera/rigid3d.h"

namespace scattermeter {

struct PointPair {
  Eigen::Vector3d world_mm;
  Eigen::Vector2d image_px;
};

// Each status with its condition, in the order in which they are tested.
enum class PoseStatus {
  kOk,
  // Fewer than four pairs, four different world points, or four inliers.
  kTooFewPoints,
  // World points collinear or coincident: their spread across the line, as seen, is below three
  // standard deviations of the noise. The same for the image points (a plane seen edge-on; or the
  // rms spread of all image points below four of them).
  kCollinear,
  // No pose explains more than half of the pairs within inlier_px.
  kNoConsensus,
  // A pose that puts the points behind the camera (x -> -x) explains more pairs than any before it,
  // and more than half: the world coordinates are mirrored. (Undecidable for coplanar points alone:
  // the mirror image of a plane is the plane seen from behind.)
  kBehindCamera,
  // Some rotation is uncertain by more than 0.05 rad, or the camera's position by more than 0.05 of
  // its distance to the points (beyond, the linearised covariance no longer holds: of 14105 random
  // layouts below these limits, 4 to 12 points of any flatness and distance, 2 were farther from
  // the truth than it allows once in 10^7); or the covariance is not finite, or the least squares
  // did not converge.
  kIllConditioned,
  // Two poses that differ by more than three standard deviations fit about equally well: points in
  // one plane (or nearly) seen small, or only four to six points. See
  // calib::PoseOptions::ambiguity_ratio.
  kPlanarAmbiguity,
};

// Change of a pose, (w, dt) as in PoseResult::covariance, per unit of each lens parameter.
using PosePerLens = Eigen::Matrix<double, 6, kLensParameters>;

struct PoseResult {
  PoseStatus status = PoseStatus::kTooFewPoints;
  std::string message;  // what is wrong and what to do; "" if ok
  // From here on: the best pose found, for inspection, where status is kOk, kIllConditioned or
  // kPlanarAmbiguity; otherwise NaN, with all pairs outliers.
  Rigid3d camera_from_world;
  // Covariance of (w in rad, dt in mm), 6 x 6, of the correction from this estimate to the true
  // pose:
  //   true rotation = exp([w]_x) * camera_from_world.rotation,
  //   true translation_mm = camera_from_world.translation_mm + dt,
  // both in camera axes. A world point at y = rotation * x_in_world moves by w x y + dt; dt is the
  // displacement of the world's origin in the camera frame. Linearised: good as long as the
  // second-order motion of the points, |w|^2 |y| / 2 seen from the camera, is below noise_std_px,
  // which a world origin on or near the object ensures.
  Eigen::Matrix<double, 6, 6> covariance;
  // Derivative of the fitted pose by the lens parameters, the image points fixed:
  // -(J^T J)^-1 J^T J_lens over the inliers. A pose fitted with a lens absorbs much of that lens's
  // error: a focal length 1 % too long puts the camera 1 % too far away.
  PosePerLens per_lens_parameter = PosePerLens::Zero();
  // Standard deviation per image coordinate that the covariance is based on, px: the larger of
  // point_std_px and sqrt(sum r^2 / (2 n - 6)) over the n inliers.
  double noise_std_px = 0;
  std::vector<Eigen::Vector2d> residuals_px;  // projected - given, one per pair, outliers too; NaN
                                              // where a point has no image
  std::vector<bool> inlier;                   // one per pair
  double rms_px = 0;                          // over inliers, of the 2-vector's length
  double worst_px = 0;                        // over inliers
  // Standard deviation of the camera's centre along the world's axes, mm, from the covariance.
  Eigen::Vector3d center_std_mm;
};

}  // namespace scattermeter
