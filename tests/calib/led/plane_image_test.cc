#include "calib/led/plane_image.h"

#include <gtest/gtest.h>

#include "tests/fixtures/calib/led_scenes.h"

namespace scattermeter::calib {
namespace {

WhitePlane centred_plane(double width_mm, double height_mm) {
  WhitePlane plane;
  plane.width_mm = width_mm;
  plane.height_mm = height_mm;
  plane.origin_mm = {-0.5 * width_mm, -0.5 * height_mm, 0};
  return plane;
}

// A camera 200 mm above the plane that looks straight down, x to the right and y towards -y.
Rigid3d from_above() {
  Rigid3d pose;
  pose.rotation = Eigen::Quaterniond(0, 1, 0, 0);
  pose.translation_mm = {0, 0, 200};
  return pose;
}

TEST(PlaneImage, HoldsAFrontalPlane) {
  CameraIntrinsics k;
  k.width_px = 600;
  k.height_px = 400;
  k.fx_px = k.fy_px = 1000;
  k.cx_px = 300;
  k.cy_px = 200;
  const PlaneImage image = plane_image(k, from_above(), centred_plane(40, 20));
  // 5 px a mm: 200 .. 400 and 150 .. 250.
  EXPECT_EQ(image.x0, 200);
  EXPECT_EQ(image.y0, 150);
  EXPECT_EQ(image.width, 201);
  EXPECT_EQ(image.height, 101);
  // At a corner the distance is longer and the plane foreshortened: r / f / (d / r).
  EXPECT_NEAR(image.mm_per_px, (200.0 * 200.0 + 20.0 * 20.0 + 10.0 * 10.0) / 200.0 / 1000.0, 1e-9);
}

TEST(PlaneImage, IsCutToTheFrame) {
  const PlaneImage image = plane_image(led_camera(), led_camera_pose(), centred_plane(500, 36));
  EXPECT_EQ(image.x0, 0);
  EXPECT_EQ(image.width, led_camera().width_px);
  EXPECT_EQ(image.y0 % 2, 0);
}

TEST(PlaneImage, NoneFromBehindOrOutOfView) {
  WhitePlane behind = centred_plane(50, 36);
  behind.y_axis = -behind.y_axis;
  EXPECT_EQ(plane_image(led_camera(), led_camera_pose(), behind).width, 0);
  WhitePlane away = centred_plane(50, 36);
  away.origin_mm.x() += 500;
  EXPECT_EQ(plane_image(led_camera(), led_camera_pose(), away).width, 0);
}

}  // namespace
}  // namespace scattermeter::calib
