// The uncertainty of a calibrated LED.
#pragma once

#include <array>

#include <Eigen/Core>

namespace scattermeter {

// Rows of an LED's covariance: position (world, mm) 0 1 2, axis (rad, along two
// tangents) 3 4, exponent 5, natural logarithm of the intensity on the axis of R, G, B 6 7 8.
inline constexpr Eigen::Index kLedParameters = 9;
inline constexpr Eigen::Index kLedAxis = 3;
inline constexpr Eigen::Index kLedExponent = 5;
inline constexpr Eigen::Index kLedLogIntensity = 6;
using LedVector = Eigen::Matrix<double, kLedParameters, 1>;
using LedMatrix = Eigen::Matrix<double, kLedParameters, kLedParameters>;

struct LedUncertainty {
  // Unit vectors perpendicular to the axis and to each other; the true axis is
  // (axis + a0 tangents[0] + a1 tangents[1]), normalised.
  std::array<Eigen::Vector3d, 2> tangents = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  LedMatrix covariance = LedMatrix::Zero();
  // The part shared by all LEDs that were calibrated with the same white plane:
  // common common^T, one standard deviation of the plane's albedo. covariance - common common^T is
  // positive semidefinite.
  LedVector common = LedVector::Zero();
};

}  // namespace scattermeter
