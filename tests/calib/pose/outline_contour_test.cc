#include "calib/pose/outline_contour.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/mesh/bodies.h"
#include "tests/fixtures/calib/painted_body.h"

namespace scattermeter::calib {
namespace {

// The contour of a sphere: lines of sight that touch it, with normals away from its centre.
TEST(OutlineContour, OfASphere) {
  const RayScene scene(body_mesh("sphere"));
  const CameraIntrinsics lens = outline_lens();
  const Rigid3d pose = outline_view();
  const auto points = contour_points(scene, lens, pose, 2);
  const Box3d box = bounds(scene.mesh());
  const Eigen::Vector3d center_mm = box.center_mm();
  const double radius_mm = 0.5 * box.size_mm().x();
  const Eigen::Vector3d eye_mm = inverse(pose).translation_mm;
  const Eigen::Vector2d center_px = project(lens, pose, {center_mm}).front();
  // Its circumference in cells.
  const double cells = 2 * M_PI * radius_mm / (center_mm - eye_mm).norm() * lens.fx_px / 2;
  ASSERT_GT(points.size(), 0.7 * cells);
  ASSERT_LT(points.size(), 1.5 * cells);
  for (const ContourPoint& p : points) {
    const Eigen::Vector3d along = (p.point_mm - eye_mm).normalized();
    const double distance_mm = (center_mm - eye_mm).cross(along).norm();
    // The mesh is a polyhedron within the sphere.
    EXPECT_NEAR(distance_mm, radius_mm, 0.02 * radius_mm);
    EXPECT_GT(p.outward.dot((p.at_px - center_px).normalized()), 0.97);
    EXPECT_LT((project(lens, pose, {p.point_mm}).front() - p.at_px).norm(), 1e-3);
  }
}

// Just inside there is the body, just outside there is not; corners have no points.
TEST(OutlineContour, OfACube) {
  const RayScene scene(cube_mesh());
  const CameraIntrinsics lens = outline_lens();
  const Rigid3d pose = outline_view();
  const auto points = contour_points(scene, lens, pose, 2);
  ASSERT_GT(points.size(), 100U);
  const Lens prepared(lens);
  const Eigen::Vector3d eye_mm = inverse(pose).translation_mm;
  const auto hit = [&](const Eigen::Vector2d& px) {
    return scene.first_hit(eye_mm, pose.rotation.conjugate() * prepared.unproject(px).homogeneous())
               .facet_idx >= 0;
  };
  for (const ContourPoint& p : points) {
    EXPECT_TRUE(hit(p.at_px - 0.1 * p.outward));
    EXPECT_FALSE(hit(p.at_px + 0.1 * p.outward));
  }
  EXPECT_TRUE(contour_points(scene, lens, {pose.rotation, -pose.translation_mm}, 2).empty());
}

}  // namespace
}  // namespace scattermeter::calib
