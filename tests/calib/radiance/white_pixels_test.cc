#include "calib/radiance/white_pixels.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

// A camera 200 mm above the plane z = 0 that looks straight down: 1 px is 1 mm.
CameraView view_from_above() {
  CameraView view;
  view.intrinsics.width_px = 96;
  view.intrinsics.height_px = 64;
  view.intrinsics.fx_px = view.intrinsics.fy_px = 200;
  view.intrinsics.cx_px = 47.5;
  view.intrinsics.cy_px = 31.5;
  view.camera_from_world.rotation = Eigen::Quaterniond(0, 1, 0, 0);
  view.camera_from_world.translation_mm = {0, 0, 200};
  return view;
}

WhitePlane plane_about_origin(double width_mm, double height_mm) {
  WhitePlane plane;
  plane.origin_mm = {-0.5 * width_mm, -0.5 * height_mm, 0};
  plane.width_mm = width_mm;
  plane.height_mm = height_mm;
  return plane;
}

TEST(WhitePixels, AreThoseInsideTheMargin) {
  EXPECT_EQ(white_pixels(plane_about_origin(40, 30), view_from_above(), 0.0).size(), 40U * 30U);
  EXPECT_EQ(white_pixels(plane_about_origin(40, 30), view_from_above(), 2.0).size(), 36U * 26U);
  EXPECT_EQ(white_pixels(plane_about_origin(40, 30), view_from_above(), -1.0).size(), 42U * 32U);
  // More than the frame holds.
  EXPECT_EQ(white_pixels(plane_about_origin(400, 300), view_from_above(), 0.0).size(), 96U * 64U);
}

TEST(WhitePixels, PointsLieOnThePlaneWhereThePixelLooks) {
  for (const WhitePixel& p : white_pixels(plane_about_origin(40, 30), view_from_above(), 0.0)) {
    const double x = static_cast<double>(p.pixel % 96) - 47.5;
    const double y = static_cast<double>(p.pixel / 96) - 31.5;
    ASSERT_LT((p.point_mm - Eigen::Vector3d(x, -y, 0)).norm(), 1e-3);
  }
}

TEST(WhitePixels, NoneOfTheBack) {
  WhitePlane plane = plane_about_origin(40, 30);
  plane.y_axis = -plane.y_axis;
  plane.origin_mm.y() = 15;
  EXPECT_TRUE(white_pixels(plane, view_from_above(), 0.0).empty());
}

}  // namespace
}  // namespace scattermeter::calib
