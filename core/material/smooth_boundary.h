// Directions at a smooth dielectric boundary.
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace scattermeter {

// Direction of flight after reflection at a plane; normal of unit length, either side.
inline Eigen::Vector3d reflected(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal) {
  return direction - 2.0 * direction.dot(normal) * normal;
}

// Direction of flight behind the boundary (Snell). normal: of unit length, against the direction.
// eta: index behind the boundary over that before it. Precondition: no total reflection.
inline Eigen::Vector3d refracted(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal,
                                 double eta) {
  const double cos_before = -direction.dot(normal);
  const double sin2_behind = (1.0 - cos_before * cos_before) / (eta * eta);
  const double cos_behind = std::sqrt(std::fmax(0.0, 1.0 - sin2_behind));
  return direction / eta + (cos_before / eta - cos_behind) * normal;
}

}  // namespace scattermeter
