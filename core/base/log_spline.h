// Smooth functions of distance for the logarithm of r.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// f(t) = sum over i of c_i B_i(t), cubic B-splines on any increasing breaks (de Boor 1978, ch. IX),
// end breaks fourfold. Written in theta, with c_0 = theta_0 and c_i = c_(i-1) - theta_i: f falls
// with t wherever theta_1 ... >= 0.
class LogSpline {
 public:
  // At least two breaks, strictly increasing (std::invalid_argument).
  explicit LogSpline(std::vector<double> breaks);

  Eigen::Index size() const { return static_cast<Eigen::Index>(padded_.size()) - 4; }
  // Row: f or one of its first three derivatives at t in terms of theta; t is clamped to the
  // breaks.
  Eigen::RowVectorXd row(double t, int derivative = 0) const;
  // Matrix Q with |Q theta|^2 = ∫ (f''' - f''/2)^2 exp((t - t_0) / 2) dt, t_0 the first break, by
  // Gauss's two points in each interval. It vanishes for f = a - p t - b exp(t/2): with
  // t = log(d^2 + z0^2) that is r = const (d^2 + z0^2)^-p exp(-b sqrt(d^2 + z0^2)), a power law
  // with an exponential tail, like light that diffuses from a depth z0. The weight, which is the
  // distance itself, lets f bend more freely near the source, where r depends on how the light
  // entered, than far away, where diffusion has erased that.
  Eigen::MatrixXd roughness() const;

 private:
  std::vector<double> padded_;
};

}  // namespace scattermeter
