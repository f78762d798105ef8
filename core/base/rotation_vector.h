// Rotations by their vectors.
#pragma once

#include <Eigen/Geometry>

namespace scattermeter {

// By |w| rad about w: exp([w]_x) (Rodrigues 1840); the identity for 0.
inline Eigen::Quaterniond rotation_by(const Eigen::Vector3d& w) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(w.norm(), w.stableNormalized()));
}

}  // namespace scattermeter
