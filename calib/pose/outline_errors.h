// Errors that the points of a body's outline have in common.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/edge_points.h"

namespace scattermeter::calib {

// Every point has an error of its own. Besides, the corners of the mesh are displaced in the
// picture, in any direction, and an edge between two of them is moved by the mean of their
// displacements, weighted by the nearness of each: all edges that meet in a corner move with it.
class OutlineErrors {
 public:
  // Of points[which], by the scatters of EdgeFitOptions.
  OutlineErrors(const std::vector<EdgePoint>& points, const std::vector<std::size_t>& which,
                double line_std_px, double piece_std_px);

  // Errors outwards, px (one row a point, any number of columns), as combinations of unit variance
  // that are independent.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& of_points) const;

 private:
  // With D the variances of the points' own errors and F F^T the covariance by corners:
  // (D + F F^T)^-1/2 D^1/2 = 1 - A diag(shrink) A^T, where A has the axes of D^-1/2 F.
  Eigen::VectorXd inverse_std_;  // of D
  Eigen::MatrixXd axes_;
  Eigen::VectorXd shrink_;
};

}  // namespace scattermeter::calib
