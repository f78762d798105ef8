#include "core/camera/response_curve.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/base/dense_solve.h"

namespace scattermeter {

ResponseCurve::ResponseCurve(std::vector<double> knot_counts, std::vector<double> log_ratio)
    : knot_counts_(std::move(knot_counts)), log_ratio_(std::move(log_ratio)) {
  const std::size_t n = knot_counts_.size();
  if (n > 4 || log_ratio_.size() != n) {
    throw std::invalid_argument("ResponseCurve: " + std::to_string(n) + " knots and " +
                                std::to_string(log_ratio_.size()) + " values, at most 4 wanted");
  }
  double before = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!(knot_counts_[i] > before) || !std::isfinite(knot_counts_[i]) ||
        !std::isfinite(log_ratio_[i])) {
      throw std::invalid_argument("ResponseCurve: knots must ascend from above 0 and be finite");
    }
    before = knot_counts_[i];
  }
  if (n == 0) return;
  // Vandermonde's system in y / last knot: four knots at most, well conditioned.
  const auto size = static_cast<Eigen::Index>(n);
  Eigen::MatrixXd powers(size, size);
  Eigen::VectorXd values(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const double v = knot_counts_[static_cast<std::size_t>(i)] / knot_counts_.back();
    for (Eigen::Index k = 0; k < size; ++k) powers(i, k) = std::pow(v, k + 1);
    values[i] = log_ratio_[static_cast<std::size_t>(i)];
  }
  monomial_ = solve_lu(powers, values);
}

double ResponseCurve::log_ratio_at(double recorded_counts) const {
  if (is_identity() || !(recorded_counts > 0.0)) return 0.0;
  const double v = recorded_counts / knot_counts_.back();
  double sum = 0.0;
  for (Eigen::Index k = monomial_.size(); k-- > 0;) sum = (sum + monomial_[k]) * v;
  return sum;
}

double ResponseCurve::slope_at(double recorded_counts) const {
  if (is_identity() || !(recorded_counts > 0.0)) return 0.0;
  const double v = recorded_counts / knot_counts_.back();
  double sum = 0.0;
  for (Eigen::Index k = monomial_.size(); k-- > 0;) {
    sum = sum * v + static_cast<double>(k + 1) * monomial_[k];
  }
  return sum / knot_counts_.back();
}

double ResponseCurve::light_counts(double recorded_counts) const {
  return recorded_counts * std::exp(log_ratio_at(recorded_counts));
}

double ResponseCurve::gain_at(double recorded_counts) const {
  return std::exp(log_ratio_at(recorded_counts)) *
         (1.0 + recorded_counts * slope_at(recorded_counts));
}

Eigen::RowVectorXd ResponseCurve::weights(const std::vector<double>& knot_counts,
                                          double recorded_counts) {
  const auto n = static_cast<Eigen::Index>(knot_counts.size());
  Eigen::RowVectorXd out = Eigen::RowVectorXd::Zero(n);
  if (!(recorded_counts > 0.0)) return out;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double at = knot_counts[static_cast<std::size_t>(i)];
    double w = recorded_counts / at;
    for (Eigen::Index j = 0; j < n; ++j) {
      const double other = knot_counts[static_cast<std::size_t>(j)];
      if (j != i) w *= (recorded_counts - other) / (at - other);
    }
    out[i] = w;
  }
  return out;
}

}  // namespace scattermeter
