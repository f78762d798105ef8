#include "core/recovered_reflectance.h"

#include <algorithm>
#include <cmath>

#include "core/symmetric_eigen.h"

namespace scattermeter {

double RecoveredReflectance::noise_excess() const {
  const double left = static_cast<double>(rows) - static_cast<double>(whitened.size());
  return std::max(1.0, floor_chi2 / std::max(1.0, left));
}

Eigen::VectorXd RecoveredReflectance::values() const { return inverse * whitened; }

RecoveredReflectance recover_reflectance(const DenseSystem& system, double rank_tolerance) {
  const Eigen::Index n_knots = system.weights.cols();
  const Eigen::Index n = n_knots + system.nuisance_columns.cols();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  double l2 = 0.0;
  // In blocks: no second copy of the whole system.
  constexpr Eigen::Index kBlock = 512;
  for (Eigen::Index at = 0; at < system.weights.rows(); at += kBlock) {
    const Eigen::Index m = std::min(kBlock, system.weights.rows() - at);
    const Eigen::VectorXd inverse_std = system.std_l.segment(at, m).cwiseInverse();
    Eigen::MatrixXd w(m, n);
    w.leftCols(n_knots) = inverse_std.asDiagonal() * system.weights.middleRows(at, m);
    if (n > n_knots) {
      w.rightCols(n - n_knots) =
          inverse_std.asDiagonal() * system.nuisance_columns.middleRows(at, m);
    }
    const Eigen::VectorXd l = inverse_std.cwiseProduct(system.l.segment(at, m));
    information.selfadjointView<Eigen::Lower>().rankUpdate(w.transpose());
    right.noalias() += w.transpose() * l;
    l2 += l.squaredNorm();
  }
  // Columns that nothing touches scale to zero rather than to infinity.
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt();
  const Eigen::VectorXd inverse_scale =
      scale.unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  const Eigen::MatrixXd scaled = inverse_scale.asDiagonal() *
                                 Eigen::MatrixXd(information.selfadjointView<Eigen::Lower>()) *
                                 inverse_scale.asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(scaled);
  const Eigen::VectorXd& lambda = eigen.values;  // ascending
  const double limit = rank_tolerance * std::max(0.0, lambda[n - 1]);
  Eigen::Index first = 0;
  while (first < n && !(lambda[first] > limit)) ++first;
  const Eigen::Index rank = n - first;
  RecoveredReflectance out;
  const Eigen::VectorXd root = lambda.tail(rank).cwiseSqrt();
  const Eigen::MatrixXd vectors = eigen.vectors.rightCols(rank);
  out.sqrt_information = root.asDiagonal() * vectors.transpose() * scale.asDiagonal();
  out.inverse = inverse_scale.asDiagonal() * vectors * root.cwiseInverse().asDiagonal();
  out.whitened = out.inverse.transpose() * right;
  out.floor_chi2 = std::max(0.0, l2 - out.whitened.squaredNorm());
  out.rows = static_cast<std::size_t>(system.weights.rows());
  return out;
}

}  // namespace scattermeter
