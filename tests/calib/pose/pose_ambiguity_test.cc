#include "calib/pose/pose_ambiguity.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

struct Found {
  PoseFit first;
  std::optional<PoseFit> second;
};

Found find(const std::vector<Eigen::Vector3d>& points, double distance_mm, double tilt_rad) {
  std::mt19937_64 random(51);
  const Rigid3d pose = camera_looking_at({0, 0, 0}, distance_mm, tilt_rad, 0.8);
  const PoseScene scene = make_scene(long_lens(), shot(long_lens(), pose, points, 0.3, &random));
  const std::vector<bool> all(points.size(), true);
  Found found;
  found.first = refine_pose(
      scene, all, {pose.rotation.toRotationMatrix(), (pose * scene.centroid_mm) / scene.scale_mm});
  found.second = second_pose(scene, all, found.first, 0.3);
  return found;
}

// Far away the image of a plane is a parallel projection, which does not change when the plane's
// normal is mirrored at the line of sight: from tilt t to tilt -t.
TEST(SecondPose, OfAFarPlaneIsTheReversedTilt) {
  std::mt19937_64 random(7);
  const Found found = find(slab_points(30, 10, 0, &random), 3000, 0.5);
  ASSERT_TRUE(found.second);
  const Eigen::Vector3d sight = found.first.pose.center.normalized();
  const Eigen::Vector3d normal = found.first.pose.rotation.col(2);
  const Eigen::Vector3d mirrored = 2 * sight.dot(normal) * sight - normal;
  // Tilts are known to some 0.02 rad at this distance.
  EXPECT_LT(std::acos(mirrored.dot(found.second->pose.rotation.col(2))), 0.1);
  EXPECT_LT(found.second->sum_squares_px2, 2 * found.first.sum_squares_px2);
}

TEST(SecondPose, OfANearPlaneFitsFarWorse) {
  std::mt19937_64 random(7);
  const Found found = find(slab_points(30, 10, 0, &random), 180, 0.5);
  // Keystoning moves the corners by f h / z * (h sin t / z) = 15 px from one pose to the other's
  // start, some of which the fit takes up.
  if (found.second) {
    EXPECT_GT(found.second->sum_squares_px2, 100 * found.first.sum_squares_px2);
  }
}

TEST(SecondPose, OfASolidFitsFarWorse) {
  const Found found = find(cube_points(10), 3000, 0.5);
  if (found.second) {
    EXPECT_GT(found.second->sum_squares_px2, 100 * found.first.sum_squares_px2);
  }
}

TEST(SecondPose, HeadOnThereIsNone) {
  std::mt19937_64 random(7);
  const Found found = find(slab_points(30, 10, 0, &random), 180, 0);
  EXPECT_FALSE(found.second);
}

}  // namespace
}  // namespace scattermeter::calib
