// The phase function of Henyey and Greenstein (1941).
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "core/base/random_stream.h"

namespace scattermeter {

// `before` turned by an angle, in the azimuth of a point of the disc; unit length to rounding.
inline Eigen::Vector3d turned(const Eigen::Vector3d& before, double cos_angle,
                              const RandomStream::DiscPoint& p) {
  const double k = std::sqrt(std::fmax(0.0, 1.0 - cos_angle * cos_angle) / p.r2);
  // Two unit vectors across `before` (Duff et al. 2017).
  const double sign = std::copysign(1.0, before.z());
  const double u = -1.0 / (sign + before.z());
  const double v = before.x() * before.y() * u;
  const Eigen::Vector3d across1(1.0 + sign * before.x() * before.x() * u, sign * v,
                                -sign * before.x());
  const Eigen::Vector3d across2(v, sign + before.y() * before.y() * u, -before.y());
  const Eigen::Vector3d after = cos_angle * before + k * p.x * across1 + k * p.y * across2;
  return after * (1.5 - 0.5 * after.squaredNorm());  // keeps rounding from adding up
}

// p(cos) = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)), 1/sr; cos: cosine between the directions
// of flight before and after scattering; mean cosine g, -1 < g < 1.
class HenyeyGreenstein {
 public:
  explicit HenyeyGreenstein(double g) : g_(g) {}

  double per_sr(double cos_angle) const {
    constexpr double kIsotropic = 0.25 / std::numbers::pi;
    if (g_ == 0.0) return kIsotropic;
    const double a = 1.0 + g_ * g_ - 2.0 * g_ * cos_angle;
    return kIsotropic * (1.0 - g_ * g_) / (a * std::sqrt(a));
  }

  // A direction after scattering; unit length to rounding.
  Eigen::Vector3d sample(const Eigen::Vector3d& before, RandomStream& random) const {
    const RandomStream::DiscPoint p = random.disc();
    if (g_ == 0.0) {  // Marsaglia 1972
      const double k = 2.0 * std::sqrt(1.0 - p.r2);
      return {k * p.x, k * p.y, 1.0 - 2.0 * p.r2};
    }
    const double a = (1.0 - g_ * g_) / (1.0 - g_ + 2.0 * g_ * p.r2);
    const double cos_angle = std::fmin(1.0, (1.0 + g_ * g_ - a * a) / (2.0 * g_));
    return turned(before, cos_angle, p);
  }

 private:
  double g_;
};

}  // namespace scattermeter
