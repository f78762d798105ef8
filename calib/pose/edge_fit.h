// Camera, lens and size of the body, from where its outline was found.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calib/pose/edge_points.h"
#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// Places in the vector of parameters; all 0 is what the rig says. A point X of body b appears where
// the lens (focal lengths e^focal, k1 + distortion) shows
//   exp(turn) (exp(w) R e^(scale + scale_b) X + t + dt) + move.
namespace edge_parameter {
inline constexpr int kPose = 0;         // w in rad, dt in mm, as of PoseResult::covariance
inline constexpr int kTurn = 6;         // 3, rad: the camera about its own centre, camera axes
inline constexpr int kMove = 9;         // 3, mm: the world as the camera sees it, camera axes
inline constexpr int kFocal = 12;       // log
inline constexpr int kDistortion = 13;  // added to k1
inline constexpr int kScale = 14;       // log, of all bodies, about the world's origin
inline constexpr int kScaleOfBody = 15;
}  // namespace edge_parameter

struct EdgeFitOptions {
  std::vector<int> free;  // parameters that are fitted
  // Information of the normal prior about 0 of all parameters, n x n; n = 15 + bodies.
  Eigen::MatrixXd prior;
  // Departures of mesh, lens and profile of the edge from the truth, standard deviations, px: of
  // each end of a line, the pieces between share both in proportion; and each piece's own.
  double line_std_px = 0;
  double piece_std_px = 0;
  bool robust = false;  // Cauchy loss on each piece by itself, lines are not held together
  double robust_px = 0.5;
};

struct EdgeFit {
  bool converged = false;
  Eigen::VectorXd value;            // all parameters
  Eigen::MatrixXd covariance;       // of all; zero for what is not free
  double chi2 = 0;                  // of points and prior
  std::vector<double> residual_px;  // found - predicted along outward, one a point
  Rigid3d camera_from_world;        // with pose, turn and move
};

int edge_parameters(const std::vector<EdgePoint>& points);  // 15 + bodies

// Least squares (Ceres) of the distances between the found places and the lines that the mesh's
// edges project to; a point may slide along its edge. Precondition (std::invalid_argument): at
// least one point; sizes fit.
EdgeFit fit_edges(const std::vector<EdgePoint>& points, const CameraIntrinsics& intrinsics,
                  const Rigid3d& camera_from_world, const EdgeFitOptions& options);

// Found - predicted along outward for the parameters' values, px; NaN where there is no image.
std::vector<double> edge_residuals_px(const std::vector<EdgePoint>& points,
                                      const CameraIntrinsics& intrinsics,
                                      const Rigid3d& camera_from_world,
                                      const Eigen::VectorXd& value);

}  // namespace scattermeter::calib
