#include "core/sums/cluster_planes.h"

#include <cstddef>

#include <Eigen/Geometry>

namespace scattermeter {

std::optional<Eigen::Matrix3d> plane_of_all(std::span<const WeightedPoint> points,
                                            const Eigen::Vector3d& center, double radius) {
  // Two points as far apart in direction as a few samples offer.
  Eigen::Vector3d a = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
  constexpr std::size_t kSamples = 8;
  const auto sample = [&](std::size_t i) -> Eigen::Vector3d {
    return points[i * (points.size() - 1) / (kSamples - 1)].at() - center;
  };
  for (std::size_t i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d d = sample(i);
    if (d.squaredNorm() > a.squaredNorm()) a = d;
  }
  for (std::size_t i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d n = a.cross(sample(i));
    if (n.squaredNorm() > normal.squaredNorm()) normal = n;
  }
  if (!(normal.norm() > 1e-2 * radius * radius)) return std::nullopt;
  normal.normalize();
  for (const WeightedPoint& p : points) {
    if (std::abs(normal.dot(p.at() - center)) > 1e-7 * radius) return std::nullopt;
  }
  Eigen::Matrix3d frame;
  frame.row(0) = a.normalized();
  frame.row(1) = normal.cross(a.normalized());
  frame.row(2) = normal;
  return frame;
}

std::optional<ClusterPlane> plane_of_many(std::span<const WeightedPoint> points, double size) {
  constexpr std::size_t kSamples = 16, kMany = 6;
  const auto sample = [&](std::size_t i) {
    return points[i * (points.size() - 1) / (kSamples - 1)].at();
  };
  for (std::size_t i = 0; i < kSamples; ++i) {
    // Neighbours in the order of an earlier split, and ones farther apart.
    for (const std::size_t step : {1, 3, 5}) {
      const Eigen::Vector3d a = sample((i + step) % kSamples) - sample(i);
      const Eigen::Vector3d b = sample((i + 2 * step) % kSamples) - sample(i);
      const Eigen::Vector3d n = a.cross(b);
      const double area = n.norm();
      if (!(area > 1e-2 * a.norm() * b.norm()) || !(area > 1e-4 * size * size)) continue;
      ClusterPlane plane{sample(i), n / area, 1e-11 * size, Eigen::Matrix3d::Zero()};
      std::size_t on = 0;
      for (std::size_t k = 0; k < kSamples; ++k) on += plane.holds(sample(k)) ? 1U : 0U;
      if (on < kMany) continue;
      plane.frame.row(0) = a.normalized();
      plane.frame.row(1) = plane.normal.cross(a.normalized());
      plane.frame.row(2) = plane.normal;
      return plane;
    }
  }
  return std::nullopt;
}

}  // namespace scattermeter
