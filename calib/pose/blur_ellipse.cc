#include "calib/pose/blur_ellipse.h"

#include <algorithm>
#include <cmath>

#include "core/base/dense_solve.h"

namespace scattermeter::calib {

double widest_blur_px(const std::vector<EdgeBlur>& edges) {
  constexpr double kDrawnBy = 4.0;
  constexpr double kAbsolute_px2 = 0.1;  // below which the sum is one of squares
  constexpr int kRounds = 20;
  if (edges.empty()) return 0.0;
  const auto n = static_cast<Eigen::Index>(edges.size());
  // n^T B n = mean + p cos(2 a) + q sin(2 a), a the direction of n.
  Eigen::MatrixXd a(n, 3);
  Eigen::VectorXd b(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const EdgeBlur& e = edges[static_cast<std::size_t>(i)];
    a.row(i) << 1.0, e.normal.x() * e.normal.x() - e.normal.y() * e.normal.y(),
        2.0 * e.normal.x() * e.normal.y();
    b[i] = e.blur_px * e.blur_px;
  }
  Eigen::VectorXd weight = Eigen::VectorXd::Ones(n);
  Eigen::VectorXd value;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixXd information = a.transpose() * weight.asDiagonal() * a;
    const double drawn = kDrawnBy * weight.mean();
    information(1, 1) += drawn;
    information(2, 2) += drawn;
    value =
        SymmetricSolver(information).solve(Eigen::VectorXd(a.transpose() * weight.cwiseProduct(b)));
    weight = ((b - a * value).cwiseAbs().array() + kAbsolute_px2).inverse().matrix();
  }
  return std::sqrt(std::max(0.0, value[0] + std::hypot(value[1], value[2])));
}

}  // namespace scattermeter::calib
