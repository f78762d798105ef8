#include "calib/pose/blur_across.h"

#include <Eigen/Cholesky>

namespace scattermeter::calib {

std::optional<Eigen::Matrix2d> point_spread_px2(const std::vector<BlurAcross>& blurs) {
  constexpr std::size_t kLeast = 8;
  if (blurs.size() < kLeast) return std::nullopt;
  constexpr int kRounds = 20;
  constexpr double kLeast_px2 = 1e-3;
  const auto n = static_cast<Eigen::Index>(blurs.size());
  // Of the mean over all directions, and of what varies with twice the direction's angle.
  Eigen::MatrixXd by(n, 3);
  Eigen::VectorXd px2(n), weight = Eigen::VectorXd::Ones(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const BlurAcross& b = blurs[static_cast<std::size_t>(i)];
    const double x = b.outward.x(), y = b.outward.y();
    by.row(i) << 1.0, x * x - y * y, 2.0 * x * y;
    px2[i] = b.px2;
  }
  // Without other directions, the spread is round: as strong as one piece.
  Eigen::Vector2d round = Eigen::Vector2d::Ones();
  Eigen::Vector3d fit;
  for (int i = 0; i < kRounds; ++i) {
    Eigen::Matrix3d squares = by.transpose() * weight.asDiagonal() * by;
    squares.diagonal().tail<2>() += round;
    fit = squares.ldlt().solve(by.transpose() * weight.cwiseProduct(px2));
    weight = (px2 - by * fit).cwiseAbs().cwiseMax(kLeast_px2).cwiseInverse();
    round = fit.tail<2>().cwiseAbs().cwiseMax(kLeast_px2).cwiseInverse();
  }
  return Eigen::Matrix2d{{fit[0] + fit[1], fit[2]}, {fit[2], fit[0] - fit[1]}};
}

}  // namespace scattermeter::calib
