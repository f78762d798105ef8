// Small changes of a camera's pose, and the shift of the surface point that a sample then sees.
#pragma once

#include <Eigen/Core>

#include "core/camera/rigid3d.h"

namespace scattermeter {

// (w in rad, dt in mm), in camera axes: as in PoseResult::covariance.
using PoseShift = Eigen::Matrix<double, 6, 1>;
// rotation' = exp([w]_x) rotation, translation' = translation + dt.
Rigid3d shifted_pose(const Rigid3d& camera_from_world, const PoseShift& by);

// The shift of the pose relative to an object that is displaced (mm, first three columns) and
// turned about `center_mm` (rad, last three), in world axes: 6 x 6.
Eigen::Matrix<double, 6, 6> pose_shift_by_place(const Rigid3d& camera_from_world,
                                                const Eigen::Vector3d& center_mm);

// The shift of the pose relative to an object that is larger by the factor 1 + s about `center_mm`,
// per s: the object in units of its own size is seen from nearer.
PoseShift pose_shift_by_size(const Rigid3d& camera_from_world, const Eigen::Vector3d& center_mm);

// Change (world) of the unit vector towards the camera along a fixed sample's ray, per unit of a
// small change of pose, 3 x 6, or of the ray (X / Z, Y / Z) at a fixed pose, 3 x 2. `point_mm` is
// on the ray.
Eigen::Matrix<double, 3, 6> direction_change_by_pose(const Rigid3d& camera_from_world,
                                                     const Eigen::Vector3d& point_mm);
Eigen::Matrix<double, 3, 2> direction_change_by_ray(const Rigid3d& camera_from_world,
                                                    const Eigen::Vector3d& point_mm);

// Shift (world, mm) of the surface point that a fixed sample sees, per unit of a small change of
// pose: 3 x 6, columns (w in rad, dt in mm) with rotation' = exp([w]_x) rotation, translation' =
// translation + dt. The point stays in the plane through `point_mm` with `normal`. With p the
// point, n the normal and y = rotation * point in the camera frame, the new point has camera
// coordinates parallel to p: R dX = mu p - (w x y + dt), and n . R dX = 0 gives mu. It diverges for
// a plane seen edge-on.
Eigen::Matrix<double, 3, 6> surface_shift_by_pose(const Rigid3d& camera_from_world,
                                                  const Eigen::Vector3d& point_mm,
                                                  const Eigen::Vector3d& normal);

// The same per unit of a small change of the ray (X / Z, Y / Z) that falls on the sample, at a
// fixed pose: 3 x 2. The point moves by Z (dx, dy, 0) and along the ray back into its plane.
Eigen::Matrix<double, 3, 2> surface_shift_by_ray(const Rigid3d& camera_from_world,
                                                 const Eigen::Vector3d& point_mm,
                                                 const Eigen::Vector3d& normal);

}  // namespace scattermeter
