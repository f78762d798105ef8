// A sensor's departure from proportionality between counts and light.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// light = y exp(G(y)), both in counts above black: y as recorded, light as recorded by a sensor
// that keeps this one's sensitivity in the limit of no light. G is the polynomial through (0, 0)
// and the knots. A sensor that records 1 % too little at its top has G = +0.01 there. Without knots
// G is 0. Domain: 0 .. the last knot; beyond it the polynomial is extrapolated (unreliable farther
// out); below 0, G is its value at 0.
class ResponseCurve {
 public:
  ResponseCurve() = default;
  // At most four knots, counts ascending and positive, values finite; otherwise throws
  // std::invalid_argument.
  ResponseCurve(std::vector<double> knot_counts, std::vector<double> log_ratio);

  const std::vector<double>& knot_counts() const { return knot_counts_; }
  const std::vector<double>& log_ratio() const { return log_ratio_; }
  bool is_identity() const { return knot_counts_.empty(); }

  // G and dG/dy.
  double log_ratio_at(double recorded_counts) const;
  double slope_at(double recorded_counts) const;
  double light_counts(double recorded_counts) const;
  // d light / d recorded.
  double gain_at(double recorded_counts) const;

  // Weights of the knots' values whose sum is G at `recorded_counts`: Lagrange's polynomials, one
  // per knot.
  static Eigen::RowVectorXd weights(const std::vector<double>& knot_counts, double recorded_counts);

 private:
  std::vector<double> knot_counts_;
  std::vector<double> log_ratio_;
  Eigen::VectorXd monomial_;  // G = sum over k of monomial_[k] (y / last knot)^(k + 1)
};

}  // namespace scattermeter
