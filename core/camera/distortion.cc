#include "core/camera/distortion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/LU>

namespace scattermeter {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLargestRadius = 20.0;  // tan(87 degrees)

}  // namespace

Distortion::Distortion(const std::vector<double>& terms) {
  const size_t n = terms.size();
  if (n != 0 && n != 4 && n != 5 && n != 8) {
    throw std::invalid_argument("Distortion: expected 0, 4, 5 or 8 terms, got " +
                                std::to_string(n));
  }
  for (const double term : terms) {
    if (!std::isfinite(term)) throw std::invalid_argument("Distortion: a term is not finite");
    if (term != 0) identity_ = false;
  }
  const auto term = [&](size_t i) { return i < n ? terms[i] : 0.0; };
  k_[0] = term(0);
  k_[1] = term(1);
  p1_ = term(2);
  p2_ = term(3);
  k_[2] = term(4);
  k_[3] = term(5);
  k_[4] = term(6);
  k_[5] = term(7);
  domain_radius_ = identity_ ? std::numeric_limits<double>::infinity() : find_domain_radius();
}

double Distortion::radial_factor(double s, double* derivative) const {
  const double numerator = 1 + s * (k_[0] + s * (k_[1] + s * k_[2]));
  const double denominator = 1 + s * (k_[3] + s * (k_[4] + s * k_[5]));
  const double c = numerator / denominator;
  if (derivative != nullptr) {
    const double numerator_slope = k_[0] + s * (2 * k_[1] + s * 3 * k_[2]);
    const double denominator_slope = k_[3] + s * (2 * k_[4] + s * 3 * k_[5]);
    *derivative = (numerator_slope - c * denominator_slope) / denominator;
  }
  return c;
}

double Distortion::find_domain_radius() const {
  // d(r c(r^2))/dr = c + 2 s c'. A scan in steps of 0.1 % of the range brackets the first sign
  // change (the terms make at most degree 6 in s, far smoother than the step); bisection ends it.
  const auto inside = [&](double r) {
    const double s = r * r;
    if (1 + s * (k_[3] + s * (k_[4] + s * k_[5])) <= 0) return false;
    double slope = 0;
    const double c = radial_factor(s, &slope);
    return c + 2 * s * slope > 0;
  };
  constexpr int kSteps = 2000;
  double low = 0;
  for (int i = 1; i <= kSteps; ++i) {
    // Quadratic spacing: fine near the axis, where the first fold of a strong lens is.
    const double fraction = static_cast<double>(i) / kSteps;
    double high = kLargestRadius * fraction * fraction;
    if (inside(high)) {
      low = high;
      continue;
    }
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (inside(middle) ? low : high) = middle;
    }
    return low;
  }
  return kLargestRadius;
}

Eigen::Vector2d Distortion::apply(const Eigen::Vector2d& undistorted,
                                  Eigen::Matrix2d* jacobian) const {
  if (identity_) {
    if (jacobian != nullptr) jacobian->setIdentity();
    return undistorted;
  }
  const double x = undistorted.x();
  const double y = undistorted.y();
  const double s = x * x + y * y;
  if (!(s < domain_radius_ * domain_radius_)) {
    if (jacobian != nullptr) jacobian->setConstant(kNan);
    return {kNan, kNan};
  }
  double slope = 0;
  const double c = radial_factor(s, jacobian != nullptr ? &slope : nullptr);
  if (jacobian != nullptr) {
    // ds/dx = 2 x, ds/dy = 2 y. The Jacobian is symmetric: the map is a gradient.
    const double cross = 2 * (x * y * slope + p1_ * x + p2_ * y);
    *jacobian << c + 2 * x * x * slope + 2 * p1_ * y + 6 * p2_ * x, cross,  //
        cross, c + 2 * y * y * slope + 6 * p1_ * y + 2 * p2_ * x;
  }
  return {x * c + 2 * p1_ * x * y + p2_ * (s + 2 * x * x),
          y * c + p1_ * (s + 2 * y * y) + 2 * p2_ * x * y};
}

Eigen::Vector2d Distortion::newton(const Eigen::Vector2d& distorted, Eigen::Vector2d x,
                                   double tolerance) const {
  constexpr int kMaxIterations = 30;
  Eigen::Matrix2d jacobian;
  Eigen::Vector2d error = apply(x, &jacobian) - distorted;
  for (int i = 0; i < kMaxIterations; ++i) {
    const double size = error.norm();
    if (!(size < std::numeric_limits<double>::infinity())) break;  // left the domain
    // The tangential part can fold where the radial part does not: only the sheet that contains the
    // axis, where the determinant is positive, is physical.
    const double determinant = jacobian.determinant();
    if (!(determinant > 0)) break;
    if (size <= tolerance) return x;
    const Eigen::Vector2d step = jacobian.inverse() * error;
    // Halve the step until it stays in the domain and reduces the error.
    double fraction = 1;
    Eigen::Vector2d next_error;
    Eigen::Vector2d next;
    do {
      next = x - fraction * step;
      next_error = apply(next, &jacobian) - distorted;
      fraction *= 0.5;
    } while (!(next_error.norm() < size) && fraction > 1e-3);
    if (!(next_error.norm() < size)) break;
    x = next;
    error = next_error;
  }
  return {kNan, kNan};
}

Eigen::Vector2d Distortion::invert_radial(const Eigen::Vector2d& distorted) const {
  const double target = distorted.norm();
  if (target == 0) return distorted;
  double low = 0;
  double high = domain_radius_;
  // r c(r^2) rises over the whole domain, so bisection finds its only root; 30 halvings are a start
  // good enough for Newton's steps.
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (middle * radial_factor(middle * middle, nullptr) < target ? low : high) = middle;
  }
  return distorted * (low / target);
}

Eigen::Vector2d Distortion::invert(const Eigen::Vector2d& distorted, const Eigen::Vector2d& guess,
                                   double tolerance) const {
  if (identity_) return distorted;
  if (!distorted.allFinite()) return {kNan, kNan};
  Eigen::Vector2d near_guess = newton(distorted, guess, tolerance);
  if (near_guess.allFinite()) return near_guess;
  return newton(distorted, invert_radial(distorted), tolerance);
}

}  // namespace scattermeter
