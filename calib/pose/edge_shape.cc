#include "calib/pose/edge_shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace scattermeter::calib {

EdgeShape::EdgeShape(const Eigen::Vector2d& normal, double blur_px)
    : a_(std::max(std::abs(normal.x()), 1e-3)),
      b_(std::max(std::abs(normal.y()), 1e-3)),
      blur_(blur_px) {}

EdgeShape::Terms EdgeShape::at(double t) const {
  const double far = 0.5 * (a_ + b_);
  const double near = 0.5 * (a_ - b_);
  const auto p = integrals(t + far);
  const auto q = integrals(t + near);
  const auto r = integrals(t - near);
  const auto u = integrals(t - far);
  std::array<double, 5> mean{};
  for (std::size_t k = 0; k < 5; ++k) mean[k] = (p[k] - q[k] - r[k] + u[k]) / (a_ * b_);
  const double s1 = mean[3];
  return {{mean[2], s1, 2.0 * mean[4]},
          {mean[1], mean[2], 2.0 * s1},
          {blur_ * mean[0], blur_ * mean[1], 2.0 * blur_ * mean[2]}};
}

std::array<double, 5> EdgeShape::integrals(double t) const {
  const double z = t / blur_;
  if (z < -9) return {};
  const double v = blur_ * blur_;
  const double density =
      std::abs(z) > 9 ? 0.0 : std::exp(-0.5 * z * z) / (blur_ * std::sqrt(2 * std::numbers::pi));
  const double f0 = z > 9 ? 1.0 : 0.5 * std::erfc(-z / std::numbers::sqrt2);
  const double f1 = t * f0 + v * density;
  const double f2 = (t * f1 + v * f0) / 2;
  const double f3 = (t * f2 + v * f1) / 3;
  return {f0, f1, f2, f3, (t * f3 + v * f2) / 4};
}

}  // namespace scattermeter::calib
