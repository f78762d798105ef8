#include "calib/led/sphere_image.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

CameraIntrinsics pinhole() {
  CameraIntrinsics k;
  k.width_px = 600;
  k.height_px = 400;
  k.fx_px = k.fy_px = 1000;
  k.cx_px = 300;
  k.cy_px = 200;
  return k;
}

TEST(SphereImage, HoldsTheOutline) {
  const CameraIntrinsics k = pinhole();
  const MirrorSphere sphere{{5, -3, 200}, 10.0};
  const SphereImage image = sphere_image(k, Rigid3d{}, sphere);
  EXPECT_NEAR(image.center_px.x(), 325.0, 1e-9);
  // tan of the outline's angle: R / sqrt(d^2 - R^2).
  EXPECT_NEAR(image.radius_px, 50.1, 0.3);
  EXPECT_LE(image.x0, 325 - 50);
  EXPECT_GE(image.x0 + image.width, 325 + 50);
  EXPECT_EQ(image.x0 % 2, 0);
}

// On the optical axis the outline is a circle of radius f R / sqrt(d^2 - R^2).
TEST(SphereImage, IsACircleOnTheAxis) {
  const SphereImage image = sphere_image(pinhole(), Rigid3d{}, {{0, 0, 250}, 10.0});
  EXPECT_NEAR(image.radius_px, 1000.0 * 10.0 / std::sqrt(250.0 * 250.0 - 100.0), 1e-9);
  EXPECT_NEAR(image.center_px.y(), 200.0, 1e-12);
  EXPECT_EQ(image.width, image.height);
}

TEST(SphereImage, IsCutToTheFrame) {
  const SphereImage image = sphere_image(pinhole(), Rigid3d{}, {{60, 0, 200}, 10.0});
  EXPECT_GT(image.width, 0);
  EXPECT_EQ(image.x0 + image.width, 600);
}

TEST(SphereImage, NoneOutOfViewBehindOrAround) {
  EXPECT_EQ(sphere_image(pinhole(), Rigid3d{}, {{500, 0, 200}, 10.0}).width, 0);
  EXPECT_EQ(sphere_image(pinhole(), Rigid3d{}, {{0, 0, -200}, 10.0}).width, 0);
  EXPECT_EQ(sphere_image(pinhole(), Rigid3d{}, {{0, 0, 5}, 10.0}).width, 0);
}

}  // namespace
}  // namespace scattermeter::calib
