#include "core/transport/refracted_ray.h"

#include <algorithm>
#include <cmath>

namespace scattermeter {

RefractedRay refracted_ray(double height_mm, double depth_mm, double foot_mm,
                           double eta_int_over_ext) {
  const double eta2 = eta_int_over_ext * eta_int_over_ext;
  const double h2 = height_mm * height_mm;
  const auto eta_d_cos = [&](double r) { return std::sqrt((eta2 - 1.0) * r * r + eta2 * h2); };
  // The start is above the root, and f is concave: all other steps come from below.
  double r = foot_mm / (1.0 + depth_mm / eta_d_cos(foot_mm));
  double q = eta_d_cos(r);
  double slope = 1.0;
  for (int i = 0; i < 50; ++i) {
    slope = 1.0 + depth_mm * eta2 * h2 / (q * q * q);
    const double step = (r + depth_mm * r / q - foot_mm) / slope;
    const double before = r;
    r = std::max(0.0, r - step);
    q = eta_d_cos(r);
    // The next step is at most this times the square of this one: f'' falls with q.
    const double curvature =
        1.5 * depth_mm * (eta2 - 1.0) * eta2 * h2 * std::max(r, before) / (q * q * q * q * q);
    if (curvature * step * step <= 1e-10 * (height_mm + r)) break;
  }
  const double cos_inside = q / (eta_int_over_ext * std::sqrt(r * r + h2));
  slope = 1.0 + depth_mm * eta2 * h2 / (q * q * q);
  const double per_eta = depth_mm * r * eta_int_over_ext * (r * r + h2) / (q * q * q * slope);
  return {r, depth_mm / cos_inside, cos_inside, (1.0 + depth_mm / q) * slope, per_eta};
}

Passage passage_to(const Eigen::Vector3d& x, double depth_mm, const Eigen::Vector3d& normal,
                   const Eigen::Vector3d& foot, double height_mm, double eta) {
  // It lies between the feet of camera and point on the plane.
  const Eigen::Vector3d across = x + depth_mm * normal - foot;
  const double foot_mm = across.norm();
  const RefractedRay ray = refracted_ray(height_mm, depth_mm, foot_mm, eta);
  if (!(foot_mm > 0.0)) return {ray, foot};
  return {ray, foot + (ray.radius_mm / foot_mm) * across,
          (ray.radius_mm_per_eta / foot_mm) * across};
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> passage_between(const Eigen::Vector3d& x,
                                                            double depth_mm,
                                                            const Eigen::Vector3d& normal,
                                                            const Eigen::Vector3d& foot,
                                                            double height_mm, double eta) {
  const Eigen::Vector3d across = x + depth_mm * normal - foot;
  const double least = eta * height_mm;
  // sqrt(1 + u) <= 1 + u / 2.
  const double most = least + 0.5 * (eta * eta - 1.0) * across.squaredNorm() / least;
  return {foot + least / (least + depth_mm) * across, foot + most / (most + depth_mm) * across};
}

}  // namespace scattermeter
