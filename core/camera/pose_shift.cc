#include "core/camera/pose_shift.h"

#include <Eigen/Geometry>

#include "core/base/cross_matrix.h"

namespace scattermeter {
namespace {

// Along the ray through p into the plane through p with normal n, all in camera axes.
Eigen::Matrix3d onto_plane(const Eigen::Vector3d& p, const Eigen::Vector3d& n) {
  return Eigen::Matrix3d::Identity() - p * n.transpose() / n.dot(p);
}

}  // namespace

Rigid3d shifted_pose(const Rigid3d& camera_from_world, const PoseShift& by) {
  const double angle = by.head<3>().norm();
  Rigid3d out = camera_from_world;
  if (angle > 0.0) {
    out.rotation =
        (Eigen::Quaterniond(Eigen::AngleAxisd(angle, by.head<3>() / angle)) * out.rotation)
            .normalized();
  }
  out.translation_mm += by.tail<3>();
  return out;
}

Eigen::Matrix<double, 6, 6> pose_shift_by_place(const Rigid3d& camera_from_world,
                                                const Eigen::Vector3d& center_mm) {
  const Eigen::Matrix3d rotation = camera_from_world.rotation.toRotationMatrix();
  Eigen::Matrix<double, 6, 6> out = Eigen::Matrix<double, 6, 6>::Zero();
  out.topRightCorner<3, 3>() = rotation;
  out.bottomLeftCorner<3, 3>() = rotation;
  out.bottomRightCorner<3, 3>() = rotation * cross_matrix(center_mm);
  return out;
}

PoseShift pose_shift_by_size(const Rigid3d& camera_from_world, const Eigen::Vector3d& center_mm) {
  PoseShift out;
  // The camera's centre moves by -s (centre - center_mm).
  out << Eigen::Vector3d::Zero(), -(camera_from_world * center_mm);
  return out;
}

Eigen::Matrix<double, 3, 6> direction_change_by_pose(const Rigid3d& camera_from_world,
                                                     const Eigen::Vector3d& point_mm) {
  const Eigen::Vector3d ray = (camera_from_world * point_mm).normalized();
  Eigen::Matrix<double, 3, 6> out = Eigen::Matrix<double, 3, 6>::Zero();
  // The camera turns by w, and the world against it: the ray in the world by -w.
  out.leftCols<3>() =
      -(camera_from_world.rotation.conjugate().toRotationMatrix() * cross_matrix(ray));
  return out;
}

Eigen::Matrix<double, 3, 2> direction_change_by_ray(const Rigid3d& camera_from_world,
                                                    const Eigen::Vector3d& point_mm) {
  const Eigen::Vector3d p = camera_from_world * point_mm;
  const Eigen::Vector3d ray = p.normalized();
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - ray * ray.transpose();
  return -(camera_from_world.rotation.conjugate().toRotationMatrix() * across *
           Eigen::Matrix<double, 3, 2>::Identity()) *
         (p.z() / p.norm());
}

Eigen::Matrix<double, 3, 6> surface_shift_by_pose(const Rigid3d& camera_from_world,
                                                  const Eigen::Vector3d& point_mm,
                                                  const Eigen::Vector3d& normal) {
  const Eigen::Matrix3d rotation = camera_from_world.rotation.toRotationMatrix();
  const Eigen::Vector3d p = camera_from_world * point_mm;
  const Eigen::Vector3d n = rotation * normal;
  // Movement of the point in the camera frame at a fixed world point: w x y + dt.
  const Eigen::Vector3d y = rotation * point_mm;
  Eigen::Matrix<double, 3, 6> movement;
  for (int i = 0; i < 3; ++i) {
    movement.col(i) = Eigen::Vector3d::Unit(i).cross(y);
    movement.col(3 + i) = Eigen::Vector3d::Unit(i);
  }
  return -(rotation.transpose() * onto_plane(p, n) * movement);
}

Eigen::Matrix<double, 3, 2> surface_shift_by_ray(const Rigid3d& camera_from_world,
                                                 const Eigen::Vector3d& point_mm,
                                                 const Eigen::Vector3d& normal) {
  const Eigen::Matrix3d rotation = camera_from_world.rotation.toRotationMatrix();
  const Eigen::Vector3d p = camera_from_world * point_mm;
  return rotation.transpose() * onto_plane(p, rotation * normal) * p.z() *
         Eigen::Matrix<double, 3, 2>::Identity();
}

}  // namespace scattermeter
