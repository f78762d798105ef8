// Least squares over lens and board poses at once, and what it says of their uncertainty.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/pose.h"
#include "core/camera/lens_parameters.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// One picture of a flat board. `world_mm` of a corner is its place on the board.
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

// Moves the parameters of `model` and all poses to the least sum of squared distances in the image
// (Ceres, analytic derivatives). cauchy_px > 0: of Cauchy's loss with this scale, which wrong
// corners hardly pull. Parameters outside of the model are set to 0 (fy to fx with one focal
// length). Every corner needs an image at the start; a start without is returned as it is, not
// converged. Deterministic, one thread.
CameraBundle adjust_bundle(const std::vector<BoardView>& views, const LensModel& model,
                           int width_px, int height_px, const CameraBundle& start,
                           double cauchy_px = 0);

// Projected - given per corner of a view, NaN without image.
std::vector<Eigen::Vector2d> view_residuals(const BoardView& view, const Rigid3d& camera_from_board,
                                            const CameraIntrinsics& intrinsics);

// The problem linearised at a bundle, each view's pose eliminated: with a step d of the fitted
// parameters and the best pose for it, a view's residuals are r + A d, A = (1 - B B^+) dr/dp.
struct ViewEquations {
  Eigen::MatrixXd information;  // A^T A, P x P, px^2 per (unit of parameter)^2
  Eigen::VectorXd gradient;     // A^T r
  double sum_squares_px2 = 0;   // r^T r, with the pose's own share taken out
  std::size_t n_corners = 0;
  // d(A^T r)/d(place of a corner on the board, 3 mm), P x 3 per corner.
  std::vector<Eigen::MatrixXd> gradient_per_mm;
};
ViewEquations view_equations(const BoardView& view, const Rigid3d& camera_from_board,
                             const CameraIntrinsics& intrinsics, const LensModel& model);

}  // namespace scattermeter::calib
