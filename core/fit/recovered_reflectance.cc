#include "core/fit/recovered_reflectance.h"

#include <algorithm>
#include <cmath>

#include "core/base/symmetric_eigen.h"

namespace scattermeter {

double RecoveredReflectance::noise_excess() const {
  const double left = static_cast<double>(rows) - static_cast<double>(whitened.size());
  return std::max(1.0, floor_chi2 / std::max(1.0, left));
}

Eigen::VectorXd RecoveredReflectance::values() const { return inverse * whitened; }

RecoveredReflectance recover_reflectance(const DenseSystem& system, double rank_tolerance) {
  return recover_reflectance(image_information(system), rank_tolerance);
}

RecoveredReflectance recover_reflectance(const ImageInformation& image, double rank_tolerance) {
  const Eigen::Index n = image.information.cols();
  // Columns that nothing touches scale to zero rather than to infinity.
  const Eigen::VectorXd scale = image.information.diagonal().cwiseSqrt();
  const Eigen::VectorXd inverse_scale =
      scale.unaryExpr([](double s) { return s > 0.0 ? 1.0 / s : 0.0; });
  const Eigen::MatrixXd scaled =
      inverse_scale.asDiagonal() * image.information * inverse_scale.asDiagonal();
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
  out.whitened = out.inverse.transpose() * image.right;
  out.floor_chi2 = std::max(0.0, image.l2 - out.whitened.squaredNorm());
  out.rows = image.rows;
  return out;
}

}  // namespace scattermeter
