#include "core/material/phase_function.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace scattermeter {
namespace {

// Moments of 3/(4 pi) cos^2.
constexpr double kSecondOfSquare = 0.4;

}  // namespace

PhaseFunction PhaseFunction::with_gamma(double g, double gamma) {
  if (g > 0.0 && g < 1.0) {
    // share * own = g, share * own^2 + (1 - share) * 0.4 = second.
    const double second = 1.0 - gamma * (1.0 - g);
    const double b = second - kSecondOfSquare;
    const double own = (b + std::sqrt(b * b + 4.0 * kSecondOfSquare * g * g)) / (2.0 * g);
    constexpr double kRounding = 1e-9;
    if (own < 1.0 && own > g * (1.0 - kRounding)) {
      return {std::fmin(1.0, g / own), std::fmax(g, own), Other::kSquaredCosine, 0.0};
    }
  }
  throw std::invalid_argument("PhaseFunction: g = " + std::to_string(g) +
                              ", gamma = " + std::to_string(gamma));
}

void PhaseFunction::check() const {
  const bool has_lobes = share_ >= 0.0 && share_ <= 1.0 && std::abs(g_) < 1.0;
  if (!has_lobes || !(std::abs(other_g_) < 1.0)) {
    throw std::invalid_argument("PhaseFunction: share " + std::to_string(share_) + " of g " +
                                std::to_string(g_) + " and " + std::to_string(other_g_));
  }
}

double PhaseFunction::other_moment(int order) const {
  if (other_ == Other::kHenyeyGreenstein) return order == 1 ? other_g_ : other_g_ * other_g_;
  return order == 1 ? 0.0 : kSecondOfSquare;
}

double PhaseFunction::other_per_sr(double cos_angle) const {
  if (other_ == Other::kHenyeyGreenstein) return HenyeyGreenstein(other_g_).per_sr(cos_angle);
  return 0.75 / std::numbers::pi * cos_angle * cos_angle;
}

Eigen::Vector3d PhaseFunction::sample_other(const Eigen::Vector3d& before,
                                            RandomStream& random) const {
  if (other_ == Other::kHenyeyGreenstein) return HenyeyGreenstein(other_g_).sample(before, random);
  // r^2 of a point of the disc is uniform and independent of its angle.
  const RandomStream::DiscPoint p = random.disc();
  return turned(before, std::cbrt(2.0 * p.r2 - 1.0), p);
}

}  // namespace scattermeter
