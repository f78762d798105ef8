// Fit of camera pose, lens and size of the bodies to the measured points of their outlines.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calib/pose/edge_points.h"
#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// Indices into the vector of parameters, which are all 0 for the rig as stated. The image of a
// point X of body b is that which the lens (focal lengths times e^focal, k1 + distortion) forms of
// the camera-frame point
//   exp(turn) (exp(w) R e^(scale + scale_b) X + t + dt) + move.
namespace edge_parameter {
inline constexpr int kPose = 0;  // w in rad, dt in mm, as in PoseResult::covariance
inline constexpr int kTurn = 6;  // 3, rad: rotation of the camera about its own centre, camera axes
inline constexpr int kMove = 9;  // 3, mm: shift of the world relative to the camera, camera axes
inline constexpr int kFocal = 12;       // log
inline constexpr int kDistortion = 13;  // added to k1
inline constexpr int kScale = 14;       // log scale of all bodies, about the world's origin
inline constexpr int kScaleOfBody = 15;
}  // namespace edge_parameter

struct EdgeFitOptions {
  std::vector<int> free;  // indices of the fitted parameters
  // Information matrix of the normal prior about 0 of all parameters, n x n with n = 15 + bodies.
  Eigen::MatrixXd prior;
  // Standard deviations of the errors of mesh, lens and edge profile, px: of each corner in either
  // direction (see OutlineErrors), and of each piece independently.
  double line_std_px = 0;
  double piece_std_px = 0;
  bool robust = false;  // Cauchy's loss for each piece independently, without lines
  double robust_px = 0.5;
};

struct EdgeFit {
  bool converged = false;
  Eigen::VectorXd value;            // all parameters
  Eigen::MatrixXd covariance;       // of all parameters; zero for those that are not free
  double chi2 = 0;                  // of points and prior
  std::vector<double> residual_px;  // measured - predicted along outward, one per point
  Rigid3d camera_from_world;        // with pose, turn and move applied
};

int edge_parameters(const std::vector<EdgePoint>& points);  // 15 + bodies

// Least squares (Ceres) of the distances between the measured points and the projected edges of the
// mesh; a point may slide along its edge. Throws std::invalid_argument without points and for a
// prior of the wrong size.
EdgeFit fit_edges(const std::vector<EdgePoint>& points, const CameraIntrinsics& intrinsics,
                  const Rigid3d& camera_from_world, const EdgeFitOptions& options);

// Measured - predicted along outward for the given parameters, px; NaN if there is no image.
std::vector<double> edge_residuals_px(const std::vector<EdgePoint>& points,
                                      const CameraIntrinsics& intrinsics,
                                      const Rigid3d& camera_from_world,
                                      const Eigen::VectorXd& value);

}  // namespace scattermeter::calib
