// Planes that hold the points of a cluster.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include <Eigen/Core>

namespace scattermeter {

struct WeightedPoint {
  Eigen::Array4d placed;  // x, y, z in mm; weight
  Eigen::Vector3d at() const { return placed.head<3>().matrix(); }
  double weight() const { return placed[3]; }
};

struct ClusterPlane {
  Eigen::Vector3d at, normal;  // mm; a unit vector
  double tolerance;            // mm
  Eigen::Matrix3d frame;       // rows: axes, the third the normal

  bool holds(const Eigen::Vector3d& p) const { return std::abs(normal.dot(p - at)) <= tolerance; }
};

// Frame whose third axis is the normal of the plane that holds all the points, if one does to
// 1e-7 of the radius (mm, about the center), which is less than floats resolve. Points: at least
// one. nullopt as well where they lie on a line.
std::optional<Eigen::Matrix3d> plane_of_all(std::span<const WeightedPoint> points,
                                            const Eigen::Vector3d& center, double radius);

// The plane of many of the points, if there is one: through three of a few samples that holds at
// least a third of them all, to 1e-11 of the size (mm, their largest side). Points: at least one.
std::optional<ClusterPlane> plane_of_many(std::span<const WeightedPoint> points, double size);

}  // namespace scattermeter
