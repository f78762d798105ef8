// Directions across another.
#pragma once

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace scattermeter {

// Two unit vectors across a unit vector and across each other: with it as the third, right-handed.
inline std::array<Eigen::Vector3d, 2> tangents(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d first = normal.unitOrthogonal();
  return {first, normal.cross(first)};
}

}  // namespace scattermeter
