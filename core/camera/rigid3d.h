// Rigid motion between two frames.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace scattermeter {

// target_from_source: x_in_target = rotation * x_in_source + translation_mm.
// Lengths in mm. `rotation` is a unit quaternion; the functions here keep it normalised.
struct Rigid3d {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator*(const Eigen::Vector3d& x_in_source_mm) const {
    return rotation * x_in_source_mm + translation_mm;
  }
};

// source_from_target of a target_from_source.
inline Rigid3d inverse(const Rigid3d& target_from_source) {
  const Eigen::Quaterniond r = target_from_source.rotation.conjugate();
  return {r, -(r * target_from_source.translation_mm)};
}

// c_from_a = c_from_b * b_from_a.
inline Rigid3d operator*(const Rigid3d& c_from_b, const Rigid3d& b_from_a) {
  return {(c_from_b.rotation * b_from_a.rotation).normalized(), c_from_b * b_from_a.translation_mm};
}

}  // namespace scattermeter
