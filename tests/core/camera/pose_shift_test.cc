#include "core/camera/pose_shift.h"

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// A ray of the camera against the plane, before and after a small change of pose.
TEST(PoseShift, MeetsTheIntersectionOfTheRay) {
  Rigid3d pose;
  pose.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 0.2, -0.3).normalized()));
  pose.translation_mm = {3, -8, 180};
  const Eigen::Vector3d point(4, -3, 11);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.4, 0.8).normalized();
  const Eigen::Vector3d ray = pose * point;
  const auto meets = [&](const Rigid3d& p) {
    const Rigid3d world_from_camera = inverse(p);
    const Eigen::Vector3d origin = world_from_camera.translation_mm;
    const Eigen::Vector3d direction = world_from_camera.rotation * ray;
    return (origin + normal.dot(point - origin) / normal.dot(direction) * direction).eval();
  };
  EXPECT_LT((meets(pose) - point).norm(), 1e-10);
  const Eigen::Matrix<double, 3, 6> shift = surface_shift_by_pose(pose, point, normal);
  for (int k = 0; k < 6; ++k) {
    const double h = k < 3 ? 1e-6 : 1e-4;
    const auto moved = [&](double by) {
      Rigid3d p = pose;
      if (k < 3) {
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(by, Eigen::Vector3d::Unit(k)));
        p.rotation = turn * pose.rotation;
      } else {
        p.translation_mm += by * Eigen::Vector3d::Unit(k - 3);
      }
      return meets(p);
    };
    const Eigen::Vector3d numeric = (moved(h) - moved(-h)) / (2.0 * h);
    EXPECT_LT((shift.col(k) - numeric).norm(), 1e-6 * numeric.norm() + 1e-9) << "column " << k;
  }
}

// Another ray of the same camera against the plane.
TEST(PoseShift, FollowsAnotherRay) {
  Rigid3d pose;
  pose.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 0.2, -0.3).normalized()));
  pose.translation_mm = {3, -8, 180};
  const Eigen::Vector3d point(4, -3, 11);
  const Eigen::Vector3d normal = Eigen::Vector3d(0.3, -0.4, 0.8).normalized();
  const Rigid3d world_from_camera = inverse(pose);
  const Eigen::Vector2d ray = (pose * point).hnormalized();
  const auto meets = [&](const Eigen::Vector2d& r) {
    const Eigen::Vector3d origin = world_from_camera.translation_mm;
    const Eigen::Vector3d direction = world_from_camera.rotation * r.homogeneous();
    return (origin + normal.dot(point - origin) / normal.dot(direction) * direction).eval();
  };
  EXPECT_LT((meets(ray) - point).norm(), 1e-10);
  const Eigen::Matrix<double, 3, 2> shift = surface_shift_by_ray(pose, point, normal);
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d h = 1e-6 * Eigen::Vector2d::Unit(k);
    const Eigen::Vector3d numeric = (meets(ray + h) - meets(ray - h)) / 2e-6;
    EXPECT_LT((shift.col(k) - numeric).norm(), 1e-6 * numeric.norm()) << "column " << k;
  }
}

}  // namespace
}  // namespace scattermeter
