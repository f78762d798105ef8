#include "calib/led/mirror_sphere.h"

#include <algorithm>
#include <cmath>

namespace scattermeter::calib {

std::optional<Eigen::Vector3d> mirror_point_mm(const MirrorSphere& sphere,
                                               const Eigen::Vector3d& eye_mm,
                                               const Eigen::Vector3d& light_mm) {
  const double r = sphere.radius_mm;
  const Eigen::Vector3d to_eye = eye_mm - sphere.center_mm;
  const Eigen::Vector3d to_light = light_mm - sphere.center_mm;
  const double a = to_eye.norm();
  const double b = to_light.norm();
  if (!(a > r) || !(b > r)) return std::nullopt;
  const Eigen::Vector3d u = to_eye / a;
  const Eigen::Vector3d across = to_light - to_light.dot(u) * u;
  const double sine = across.norm() / b;
  if (sine < 1e-14) {
    if (to_light.dot(u) < 0.0) return std::nullopt;
    return sphere.center_mm + r * u;
  }
  const Eigen::Vector3d v = across / (sine * b);
  const double gamma = std::atan2(sine, to_light.dot(u) / b);
  double low = std::max(0.0, gamma - std::acos(r / b));
  double high = std::min(gamma, std::acos(r / a));
  if (!(low < high)) return std::nullopt;
  double t = 0.5 * (low + high);
  for (int step = 0; step < 100; ++step) {
    const double rest = gamma - t;
    const double p = a * std::sin(t);
    const double q = b * std::sin(rest);
    const double p_rise = a * std::cos(t);
    const double q_fall = b * std::cos(rest);
    const double f = p * (q_fall - r) - q * (p_rise - r);
    (f > 0.0 ? high : low) = t;
    const double slope = p_rise * (q_fall - r) + 2.0 * p * q + q_fall * (p_rise - r);
    double next = t - f / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double move = std::abs(next - t);
    t = next;
    if (move < 1e-14) break;
  }
  return sphere.center_mm + r * (std::cos(t) * u + std::sin(t) * v);
}

std::optional<Eigen::Vector3d> first_point_mm(const MirrorSphere& sphere,
                                              const Eigen::Vector3d& origin_mm,
                                              const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d = direction.normalized();
  const Eigen::Vector3d to_center = sphere.center_mm - origin_mm;
  const double along = to_center.dot(d);
  const double r2 = sphere.radius_mm * sphere.radius_mm;
  const double half2 = r2 - (to_center - along * d).squaredNorm();
  if (!(along > 0.0) || !(half2 > 0.0) || !(to_center.squaredNorm() > r2)) return std::nullopt;
  return origin_mm + (along - std::sqrt(half2)) * d;
}

}  // namespace scattermeter::calib
