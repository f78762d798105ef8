#include "calib/pose/outline_errors.h"

#include <cmath>
#include <map>
#include <tuple>

#include "core/base/symmetric_eigen.h"

namespace scattermeter::calib {
namespace {

// The edge's displacement outwards by those of corners, right and down: points x (2 a corner).
Eigen::MatrixXd by_corners(const std::vector<EdgePoint>& points,
                           const std::vector<std::size_t>& which) {
  std::map<std::tuple<double, double, double>, Eigen::Index> corners;
  const auto column_of = [&](const Eigen::Vector3d& x) {
    const auto next = static_cast<Eigen::Index>(2 * corners.size());
    return corners.try_emplace({x[0], x[1], x[2]}, next).first->second;
  };
  for (const std::size_t i : which) {
    for (const Eigen::Vector3d& end : points[i].line_end_mm) column_of(end);
  }
  const auto n = static_cast<Eigen::Index>(which.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(2 * corners.size()));
  for (Eigen::Index row = 0; row < n; ++row) {
    const EdgePoint& p = points[which[static_cast<std::size_t>(row)]];
    const auto& [from, to] = p.line_end_mm;
    const double t = (p.point_mm - from).dot(to - from) / (to - from).squaredNorm();
    out.row(row).segment<2>(column_of(from)) = (1.0 - t) * p.outward.transpose();
    out.row(row).segment<2>(column_of(to)) = t * p.outward.transpose();
  }
  return out;
}

}  // namespace

OutlineErrors::OutlineErrors(const std::vector<EdgePoint>& points,
                             const std::vector<std::size_t>& which, double line_std_px,
                             double piece_std_px)
    : inverse_std_(static_cast<Eigen::Index>(which.size())) {
  for (Eigen::Index i = 0; i < inverse_std_.size(); ++i) {
    inverse_std_[i] =
        1.0 / std::hypot(points[which[static_cast<std::size_t>(i)]].std_px, piece_std_px);
  }
  if (!(line_std_px > 0.0)) return;
  const Eigen::MatrixXd common =
      line_std_px * (inverse_std_.asDiagonal() * by_corners(points, which));
  const SymmetricEigen eigen = symmetric_eigen(common.transpose() * common);
  constexpr double kNothing = 1e-12;  // of the largest
  const Eigen::Index n = eigen.values.size();
  Eigen::Index first = 0;
  while (first < n && !(eigen.values[first] > kNothing * eigen.values[n - 1])) ++first;
  const Eigen::VectorXd variance = eigen.values.tail(n - first);
  axes_ = common * eigen.vectors.rightCols(n - first) *
          variance.cwiseSqrt().cwiseInverse().asDiagonal();
  shrink_ = 1.0 - (1.0 + variance.array()).rsqrt();
}

Eigen::MatrixXd OutlineErrors::whitened(const Eigen::MatrixXd& of_points) const {
  const Eigen::MatrixXd own = inverse_std_.asDiagonal() * of_points;
  if (shrink_.size() == 0) return own;
  return own - axes_ * (shrink_.asDiagonal() * (axes_.transpose() * own));
}

}  // namespace scattermeter::calib
