// The point spread of a picture, from the blur of edges in several directions.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace scattermeter::calib {

struct BlurAcross {
  Eigen::Vector2d outward;  // unit, across the edge, right and down
  double px2;               // variance of the blur in that direction
};

// Its covariance C, px^2 right and down: n^T C n = px2 for each, with the least sum of absolute
// residuals. Edges of one direction tell it in that direction and are taken for all. Fewer than 8
// tell nothing: nullopt.
std::optional<Eigen::Matrix2d> point_spread_px2(const std::vector<BlurAcross>& blurs);

}  // namespace scattermeter::calib
