#include "core/view/camera_view.h"

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

CameraView view() {
  CameraView v;
  v.intrinsics.width_px = 640;
  v.intrinsics.height_px = 480;
  v.intrinsics.fx_px = v.intrinsics.fy_px = 1000;
  v.intrinsics.cx_px = 319.5;
  v.intrinsics.cy_px = 239.5;
  v.camera_from_world = look_at({0, -200, 10}, {0, 0, 10}, {0, 0, 1});
  return v;
}

// x right, y down, z forward, and the centre where it was put.
TEST(CameraView, LookAtHasOpenCvsAxes) {
  const CameraView v = view();
  EXPECT_LT((v.center_in_world_mm() - Eigen::Vector3d(0, -200, 10)).norm(), 1e-12);
  EXPECT_LT((v.camera_from_world * Eigen::Vector3d(0, 0, 10) - Eigen::Vector3d(0, 0, 200)).norm(),
            1e-12);
  EXPECT_LT((v.camera_from_world * Eigen::Vector3d(5, 0, 10) - Eigen::Vector3d(5, 0, 200)).norm(),
            1e-12);
  EXPECT_LT((v.camera_from_world * Eigen::Vector3d(0, 0, 17) - Eigen::Vector3d(0, -7, 200)).norm(),
            1e-12);
}

TEST(CameraView, RaysCoverTheObjectAndPointThroughTheirPixels) {
  const CameraView v = view();
  const TriangleMesh cube = test_support::make_cube();
  ASSERT_TRUE(check_view(v, cube).in_front);
  ASSERT_TRUE(check_view(v, cube).in_frame);
  const RayGrid grid = rays_around(v, cube, 3);
  // The front face, 190 mm away, spans 105.3 px about the centre.
  EXPECT_LE(grid.x0, 319.5 - 52.6 - 3);
  EXPECT_GE(grid.x0 + grid.width, 319.5 + 52.6 + 3);
  EXPECT_EQ(grid.x0 % 2, 0);
  EXPECT_EQ(grid.y0 % 2, 0);
  for (std::size_t i = 0; i < grid.directions_in_world.size(); i += 131) {
    const Eigen::Vector3d p =
        grid.origin_in_world_mm + 150.0 * grid.directions_in_world[i].cast<double>();
    const Eigen::Vector2d px = project(v.intrinsics, v.camera_from_world, {p}).front();
    EXPECT_NEAR(px.x(), grid.x0 + static_cast<int>(i) % grid.width, 1e-3);
    EXPECT_NEAR(px.y(), grid.y0 + static_cast<int>(i) / grid.width, 1e-3);
  }
}

TEST(CameraView, KnowsBehindAndBeside) {
  const CameraView v = view();
  EXPECT_FALSE(check_view(v, test_support::make_box({-10, -230, 0}, {10, -210, 20})).in_front);
  EXPECT_FALSE(check_view(v, test_support::make_box({200, -10, 0}, {220, 10, 20})).in_frame);
}

}  // namespace
}  // namespace scattermeter
