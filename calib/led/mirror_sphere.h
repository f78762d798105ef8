// Where a mirror sphere shows a light.
#pragma once

#include <optional>

#include <Eigen/Core>

namespace scattermeter::calib {

// A sphere that mirrors. Lengths in mm, world frame.
struct MirrorSphere {
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  double radius_mm = 0;      // > 0
  double center_std_mm = 0;  // standard deviation of each coordinate of the centre
  double radius_std_mm = 0;
};

// The point of the sphere that mirrors a light into an eye (Alhazen's problem), to 1e-12 of the
// radius. None where no point that both see does, or where one of them is inside.
//
// It lies in the plane through centre, eye and light. With the angle t from the direction to the
// eye (at distance a) towards that to the light (at distance b, the angle gamma apart), the angles
// of incidence agree where
//   a sin t (b cos(gamma - t) - R) = b sin(gamma - t) (a cos t - R),
// whose only root between the two horizons is found by Newton's steps inside a bracket.
std::optional<Eigen::Vector3d> mirror_point_mm(const MirrorSphere& sphere,
                                               const Eigen::Vector3d& eye_mm,
                                               const Eigen::Vector3d& light_mm);

// Where a ray from outside (direction of any length) first meets the sphere; none where it misses.
std::optional<Eigen::Vector3d> first_point_mm(const MirrorSphere& sphere,
                                              const Eigen::Vector3d& origin_mm,
                                              const Eigen::Vector3d& direction);

}  // namespace scattermeter::calib
