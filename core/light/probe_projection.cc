#include "core/light/probe_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace scattermeter {
namespace {

constexpr double kPi = std::numbers::pi;

// Gauss-Legendre on [-1, 1], eight points (Abramowitz and Stegun 25.4): the positive half.
constexpr std::array<double, 4> kGaussNode = {0.1834346424956498, 0.5255324099163290,
                                              0.7966664774136267, 0.9602898564975363};
constexpr std::array<double, 4> kGaussWeight = {0.3626837833783620, 0.3137066458778873,
                                                0.2223810344533745, 0.1012285362903763};

// Solid angle within radius r of the disc over 2 pi (the whole sphere: 2), divided by r^2.
double enclosed_over_r2(ProbeProjection projection, double r2) {
  if (projection == ProbeProjection::kMirrorBall) return 2.0;
  // 1 - cos(pi r)
  const double half = 0.5 * kPi * std::sqrt(r2);
  const double s = half > 1e-8 ? std::sin(half) / half : 1.0;
  return 0.5 * kPi * kPi * s * s;
}

// Integral over t in [a, b] of offset * G(r)/r^2, r^2 = offset^2 + t^2: flow of the field G(r)/r^2
// (x, y), whose divergence is the density of solid angle, through an edge at distance `offset` from
// the centre. Only the part within the disc counts.
double flow(ProbeProjection projection, double offset, double a, double b) {
  const double inside2 = 1.0 - offset * offset;
  if (!(inside2 > 0.0)) return 0.0;
  const double inside = std::sqrt(inside2);
  a = std::clamp(a, -inside, inside);
  b = std::clamp(b, -inside, inside);
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  double sum = 0.0;
  for (std::size_t i = 0; i < kGaussNode.size(); ++i) {
    for (double sign : {-1.0, 1.0}) {
      const double t = middle + sign * half * kGaussNode[i];
      sum += kGaussWeight[i] * enclosed_over_r2(projection, offset * offset + t * t);
    }
  }
  return offset * half * sum;
}

// Angle of the unit circle's arc within a rectangle.
double arc_inside_rad(const ImageRect& r) {
  const double x_far = std::max(std::abs(r.x0), std::abs(r.x1));
  const double y_far = std::max(std::abs(r.y0), std::abs(r.y1));
  if (x_far * x_far + y_far * y_far <= 1.0) return 0.0;
  if (r.x0 >= 1.0 || r.x1 <= -1.0 || r.y0 >= 1.0 || r.y1 <= -1.0) return 0.0;
  std::array<double, 10> at{};
  std::size_t n = 0;
  at[n++] = -kPi;
  at[n++] = kPi;
  for (double x : {r.x0, r.x1}) {
    if (std::abs(x) < 1.0) {
      at[n++] = std::acos(x);
      at[n++] = -std::acos(x);
    }
  }
  for (double y : {r.y0, r.y1}) {
    if (std::abs(y) < 1.0) {
      at[n++] = std::asin(y);
      at[n++] = y >= 0.0 ? kPi - std::asin(y) : -kPi - std::asin(y);
    }
  }
  std::sort(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(n));
  double arc = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double middle = 0.5 * (at[i] + at[i + 1]);
    const double x = std::cos(middle);
    const double y = std::sin(middle);
    if (x >= r.x0 && x <= r.x1 && y >= r.y0 && y <= r.y1) arc += at[i + 1] - at[i];
  }
  return arc;
}

}  // namespace

ProbeMap::ProbeMap(ProbeProjection projection, int width_px, int height_px)
    : projection_(projection),
      width_px_(width_px),
      height_px_(height_px),
      radius_px_(0.5 * std::min(width_px, height_px)) {
  if (width_px < 1 || height_px < 1) {
    throw std::invalid_argument("ProbeMap: size " + std::to_string(width_px) + " x " +
                                std::to_string(height_px));
  }
}

Eigen::Vector3d ProbeMap::direction(double x_px, double y_px) const {
  if (projection_ == ProbeProjection::kEquirectangular) {
    const double longitude = (x_px / width_px_ - 0.5) * 2.0 * kPi;
    const double latitude = (0.5 - y_px / height_px_) * kPi;
    return {std::sin(longitude) * std::cos(latitude), std::cos(longitude) * std::cos(latitude),
            std::sin(latitude)};
  }
  const double x = (x_px - 0.5 * width_px_) / radius_px_;
  const double z = (0.5 * height_px_ - y_px) / radius_px_;
  const double r2 = x * x + z * z;
  if (r2 >= 1.0) return {0.0, -1.0, 0.0};
  if (projection_ == ProbeProjection::kMirrorBall) {
    // Angle 2 asin(r) from +y; its sine is 2 r sqrt(1 - r^2).
    const double s = 2.0 * std::sqrt(1.0 - r2);
    return {-x * s, 1.0 - 2.0 * r2, z * s};
  }
  const double r = std::sqrt(r2);
  const double s = r > 1e-12 ? std::sin(kPi * r) / r : kPi;
  return {x * s, std::cos(kPi * r), z * s};
}

Eigen::Vector2d ProbeMap::position_px(const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d d = direction.normalized();
  const double across = std::hypot(d.x(), d.z());
  if (projection_ == ProbeProjection::kEquirectangular) {
    const double longitude = std::atan2(d.x(), d.y());
    const double latitude = std::atan2(d.z(), std::hypot(d.x(), d.y()));
    const double x = (longitude / (2.0 * kPi) + 0.5) * width_px_;
    return {x < width_px_ ? x : 0.0, (0.5 - latitude / kPi) * height_px_};
  }
  const double angle = std::atan2(across, d.y());
  const bool ball = projection_ == ProbeProjection::kMirrorBall;
  const double r = ball ? std::sin(0.5 * angle) : angle / kPi;
  if (!(across > 0.0)) return {0.5 * width_px_ + r * radius_px_, 0.5 * height_px_};
  const double x = d.x() / across * r * radius_px_;
  return {0.5 * width_px_ + (ball ? -x : x), 0.5 * height_px_ - d.z() / across * r * radius_px_};
}

double ProbeMap::disc_solid_angle_sr(const ImageRect& disc) const {
  const double through_edges =
      flow(projection_, disc.x1, disc.y0, disc.y1) - flow(projection_, disc.x0, disc.y0, disc.y1) +
      flow(projection_, disc.y1, disc.x0, disc.x1) - flow(projection_, disc.y0, disc.x0, disc.x1);
  // On the rim the field is radial, of length G(1) = 2.
  return std::max(0.0, through_edges + 2.0 * arc_inside_rad(disc));
}

double ProbeMap::solid_angle_sr(const ImageRect& rect) const {
  if (projection_ == ProbeProjection::kEquirectangular) {
    // sin a - sin b without loss of digits for a thin row.
    const double a = (0.5 - rect.y0 / height_px_) * kPi;
    const double b = (0.5 - rect.y1 / height_px_) * kPi;
    return 2.0 * kPi * (rect.x1 - rect.x0) / width_px_ * 2.0 * std::cos(0.5 * (a + b)) *
           std::sin(0.5 * (a - b));
  }
  const double cx = 0.5 * width_px_;
  const double cy = 0.5 * height_px_;
  return disc_solid_angle_sr({(rect.x0 - cx) / radius_px_, (rect.y0 - cy) / radius_px_,
                              (rect.x1 - cx) / radius_px_, (rect.y1 - cy) / radius_px_});
}

double ProbeMap::density(double x_px, double y_px) const {
  if (projection_ == ProbeProjection::kEquirectangular) {
    return std::cos((0.5 - y_px / height_px_) * kPi);
  }
  const double x = (x_px - 0.5 * width_px_) / radius_px_;
  const double y = (y_px - 0.5 * height_px_) / radius_px_;
  const double r2 = x * x + y * y;
  if (r2 >= 1.0) return 0.0;
  if (projection_ == ProbeProjection::kMirrorBall) return 4.0;
  const double r = std::sqrt(r2);
  return r > 1e-12 ? kPi * std::sin(kPi * r) / r : kPi * kPi;
}

Eigen::Vector3d ProbeMap::mean_direction(const ImageRect& rect) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weight = 0.0;
  const auto add = [&](double x, double y) {
    const double w = density(x, y);
    sum += w * direction(x, y);
    weight += w;
  };
  const double w = rect.x1 - rect.x0;
  const double h = rect.y1 - rect.y0;
  const double far_x =
      std::max(std::abs(rect.x0 - 0.5 * width_px_), std::abs(rect.x1 - 0.5 * width_px_));
  const double far_y =
      std::max(std::abs(rect.y0 - 0.5 * height_px_), std::abs(rect.y1 - 0.5 * height_px_));
  if (projection_ == ProbeProjection::kEquirectangular ||
      std::hypot(far_x, far_y) < 0.9 * radius_px_) {
    constexpr double kGauss = 0.2886751345948129;  // 1 / (2 sqrt 3)
    for (double sx : {-kGauss, kGauss}) {
      for (double sy : {-kGauss, kGauss}) {
        add(rect.x0 + (0.5 + sx) * w, rect.y0 + (0.5 + sy) * h);
      }
    }
  } else {
    // Near the rim, where a ball's directions crowd; finer across it, where a part counts or not.
    const int side = std::hypot(far_x, far_y) < radius_px_ ? 8 : 32;
    for (int i = 0; i < side * side; ++i) {
      add(rect.x0 + (i % side + 0.5) / side * w,
          rect.y0 + (static_cast<double>(i / side) + 0.5) / side * h);
    }
  }
  if (weight > 0.0) return sum / weight;
  return direction(0.5 * (rect.x0 + rect.x1), 0.5 * (rect.y0 + rect.y1));
}

}  // namespace scattermeter
