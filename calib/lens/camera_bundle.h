// Bundle adjustment: least squares over the lens and all board poses, with the equations for its
// uncertainty.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/pose.h"
#include "core/camera/lens_parameters.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// One picture of a flat board. `world_mm` of a corner is its position on the board.
struct BoardView {
  std::string name;
  std::vector<PointPair> corners;
};

struct CameraBundle {
  LensParameters lens;
  std::vector<Rigid3d> camera_from_board;  // per view
  double sum_squares_px2 = 0;              // of all residuals, without loss function
  bool converged = false;
};

// Minimises the sum of squared distances in the image over the parameters of `model` and all poses
// (Ceres, analytic derivatives). With cauchy_px > 0 it minimises Cauchy's loss with this scale, on
// which wrong corners have little influence. Parameters outside the model are set to 0 (fy to fx
// with one focal length). Every corner needs an image at the start; otherwise the start is returned
// unchanged and not converged. Deterministic, one thread.
CameraBundle adjust_bundle(const std::vector<BoardView>& views, const LensModel& model,
                           int width_px, int height_px, const CameraBundle& start,
                           double cauchy_px = 0);

// Projected minus found position of each corner of a view; NaN where it has no image.
std::vector<Eigen::Vector2d> view_residuals(const BoardView& view, const Rigid3d& camera_from_board,
                                            const CameraIntrinsics& intrinsics);

// The problem linearised at a bundle, with the pose of each view eliminated: after a step d of the
// fitted parameters and with the best pose for it, the residuals of a view are r + A d, where A =
// (1 - B B^+) dr/dp and B = dr/d(pose).
struct ViewEquations {
  Eigen::MatrixXd information;  // A^T A, P x P, px^2 per (unit of parameter)^2
  Eigen::VectorXd gradient;     // A^T r
  double sum_squares_px2 = 0;   // r^T r without the part that the pose can absorb
  std::size_t n_corners = 0;
  // d(A^T r)/d(position of a corner on the board in mm), P x 3 for each corner.
  std::vector<Eigen::MatrixXd> gradient_per_mm;
};
ViewEquations view_equations(const BoardView& view, const Rigid3d& camera_from_board,
                             const CameraIntrinsics& intrinsics, const LensModel& model);

}  // namespace scattermeter::calib
