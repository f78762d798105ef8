// Planes that contain the points of a cluster.
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

// A frame whose third axis is the normal of the plane that contains all the points to 1e-7 of the
// radius (mm, about the center), below the resolution of floats. nullopt if there is no such plane,
// or the points lie on a line. Precondition: at least one point.
std::optional<Eigen::Matrix3d> plane_of_all(std::span<const WeightedPoint> points,
                                            const Eigen::Vector3d& center, double radius);

// A plane that contains many of the points, if there is one: through three of sixteen samples,
// containing six or more of the samples to 1e-11 of the size (mm, the points' largest side).
// Precondition: at least one point.
std::optional<ClusterPlane> plane_of_many(std::span<const WeightedPoint> points, double size);

}  // namespace scattermeter
