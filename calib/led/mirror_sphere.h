// Reflection in a mirror sphere.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace scattermeter::calib {

// A mirror sphere. Lengths in mm, world frame.
struct MirrorSphere {
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  double radius_mm = 0;      // > 0
  double center_std_mm = 0;  // standard deviation of each coordinate of the centre
  double radius_std_mm = 0;
};

// The point of the sphere that reflects a light into an eye (Alhazen's problem), to 1e-12 of the
// radius. None if no such point is visible from both, or if one of them is inside the sphere.
//
// It lies in the plane through centre, eye and light. With t the angle from the direction to the
// eye (at distance a) towards the direction to the light (at distance b and angle gamma from the
// eye), the angles of incidence and reflection are equal where
//   a sin t (b cos(gamma - t) - R) = b sin(gamma - t) (a cos t - R),
// whose only root between the two horizons is found by Newton steps within a bracket.
std::optional<Eigen::Vector3d> mirror_point_mm(const MirrorSphere& sphere,
                                               const Eigen::Vector3d& eye_mm,
                                               const Eigen::Vector3d& light_mm);

// The first point where a ray from outside (direction of any length) meets the sphere; none if it
// misses.
std::optional<Eigen::Vector3d> first_point_mm(const MirrorSphere& sphere,
                                              const Eigen::Vector3d& origin_mm,
                                              const Eigen::Vector3d& direction);

}  // namespace scattermeter::calib
