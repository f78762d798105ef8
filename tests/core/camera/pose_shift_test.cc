#include "core/camera/pose_shift.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

Rigid3d some_pose() {
  Rigid3d pose;
  pose.rotation =
      Eigen::Quaterniond(Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 0.2, -0.3).normalized()));
  pose.translation_mm = {3, -8, 180};
  return pose;
}

// A ray of the camera against the plane, before and after a small change of pose.
TEST(PoseShift, MeetsTheIntersectionOfTheRay) {
  const Rigid3d pose = some_pose();
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

// The direction against a fixed sample's ray, before and after a small change of pose or ray.
TEST(PoseShift, TurnsTheDirectionTowardsTheCamera) {
  const Rigid3d pose = some_pose();
  const Eigen::Vector3d point(4, -3, 11);
  const Eigen::Vector2d ray = (pose * point).hnormalized();
  const auto towards = [&](const Rigid3d& p, const Eigen::Vector2d& r) {
    return (-(p.rotation.conjugate() * r.homogeneous().normalized())).eval();
  };
  constexpr double kStep = 1e-5;
  for (int k = 0; k < 6; ++k) {
    const PoseShift by = kStep * PoseShift::Unit(k);
    const Eigen::Vector3d numeric =
        (towards(shifted_pose(pose, by), ray) - towards(shifted_pose(pose, -by), ray)) /
        (2.0 * kStep);
    EXPECT_LT((direction_change_by_pose(pose, point).col(k) - numeric).norm(), 1e-8) << k;
  }
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d by = kStep * Eigen::Vector2d::Unit(k);
    const Eigen::Vector3d numeric =
        (towards(pose, ray + by) - towards(pose, ray - by)) / (2.0 * kStep);
    EXPECT_LT((direction_change_by_ray(pose, point).col(k) - numeric).norm(), 1e-8) << k;
  }
}

// Another ray of the same camera against the plane.
TEST(PoseShift, FollowsAnotherRay) {
  const Rigid3d pose = some_pose();
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

// An object that moves, turns or grows by a little has the same picture as one that stays before a
// camera with the shifted pose.
TEST(PoseShift, OfPlaceAndSize) {
  const Rigid3d pose = some_pose();
  const Eigen::Vector3d center(2, 5, 9);
  const Eigen::Matrix<double, 6, 6> by_place = pose_shift_by_place(pose, center);
  const PoseShift by_size = pose_shift_by_size(pose, center);
  constexpr double kStep = 1e-5;
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(4, -3, 11), Eigen::Vector3d(-9, 6, 1)}) {
    const auto image = [&](const Rigid3d& p, const Eigen::Vector3d& x) -> Eigen::Vector2d {
      return 200.0 * (p * x).hnormalized();
    };
    for (int k = 0; k < 7; ++k) {
      Eigen::Vector3d moved = point;
      if (k < 3) moved[k] += kStep;
      if (k >= 3 && k < 6) moved += kStep * Eigen::Vector3d::Unit(k - 3).cross(point - center);
      if (k == 6) moved += kStep * (point - center);
      const PoseShift shift = kStep * (k < 6 ? PoseShift(by_place.col(k)) : by_size);
      const Eigen::Vector2d expected = image(pose, moved) - image(pose, point);
      const Eigen::Vector2d found = image(shifted_pose(pose, shift), point) - image(pose, point);
      EXPECT_LT((found - expected).norm(), 1e-4 * expected.norm() + 1e-9) << "column " << k;
    }
  }
}

TEST(PoseShift, IsARotationAndATranslation) {
  Rigid3d pose;
  pose.translation_mm = {1, 2, 100};
  PoseShift by;
  by << 0.0, 0.0, 0.5, 1.0, -1.0, 3.0;
  const Rigid3d found = shifted_pose(pose, by);
  const Eigen::Vector3d expected(std::cos(0.5) + 2.0, std::sin(0.5) + 1.0, 103.0);
  EXPECT_LT((found * Eigen::Vector3d::UnitX() - expected).norm(), 1e-12);
  EXPECT_EQ(shifted_pose(pose, PoseShift::Zero()).translation_mm, pose.translation_mm);
}

}  // namespace
}  // namespace scattermeter
