#include "apps/simulation/sphere_painter.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

constexpr double kRadius_mm = 5.0;
constexpr double kDistance_mm = 8000.0;  // of camera and LED from the sphere
constexpr double kFocal_px = 32000.0;
constexpr double kIntensity = 3.0;

// 64 px across, with a sphere of 40 px at the world's origin; it looks along +z.
CameraView sphere_view() {
  CameraView view;
  view.intrinsics.width_px = view.intrinsics.height_px = 64;
  view.intrinsics.fx_px = view.intrinsics.fy_px = kFocal_px;
  view.intrinsics.cx_px = view.intrinsics.cy_px = 31.5;
  view.camera_from_world.translation_mm = {0, 0, kDistance_mm};
  return view;
}

// Lambertian, at right angles to the camera's direction.
Led side_led() {
  Led led;
  led.position_mm = {kDistance_mm, 0, 0};
  led.axis = {-1, 0, 0};
  led.exponent = 1.0;
  led.radius_mm = 480.0;
  led.intensity_W_per_sr.setConstant(kIntensity);
  return led;
}

calib::MirrorSphere sphere_at(const Eigen::Vector3d& center_mm, double radius_mm) {
  calib::MirrorSphere sphere;
  sphere.center_mm = center_mm;
  sphere.radius_mm = radius_mm;
  return sphere;
}

struct PaintedLight {
  double sum = 0;
  Eigen::Vector2d centroid_px = Eigen::Vector2d::Zero();
};

PaintedLight painted(const std::vector<calib::MirrorSphere>& spheres, const Led& led) {
  const CameraView view = sphere_view();
  RadianceCanvas canvas({}, view);
  paint_spheres(spheres, led, view, canvas);
  PaintedLight out;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      out.sum += static_cast<double>(canvas.at(x, y));
      out.centroid_px += static_cast<double>(canvas.at(x, y)) * Eigen::Vector2d(x, y);
    }
  }
  out.centroid_px /= out.sum;
  return out;
}

// A small mirror sphere scatters distant light evenly into all directions: intensity E r^2 / 4
// times the reflectance. Its Lambertian base has the phase curve of the Lambert sphere, which is 2
// / (3 pi) E r^2 times the albedo at a phase angle of 90 degrees. The sum over the pixels is the
// intensity times (f / distance)^2.
TEST(SpherePainter, ReflectsTheLightOfAMirrorSphere) {
  const Led led = side_led();
  const double d2 = kDistance_mm * kDistance_mm;
  const double r2 = kRadius_mm * kRadius_mm;
  const double disc_irradiance = kIntensity / (d2 + led.radius_mm * led.radius_mm);
  const double mirror = kMirrorReflectance * disc_irradiance * r2 / 4.0;
  const double base = kMirrorBaseAlbedo * kIntensity / d2 * r2 * 2.0 / (3.0 * std::numbers::pi);
  const double expected = (mirror + base) * kFocal_px * kFocal_px / d2;
  const PaintedLight light = painted({sphere_at({0, 0, 0}, kRadius_mm)}, led);
  EXPECT_NEAR(light.sum / expected, 1.0, 0.01);
}

// The highlight of a distant lamp at 90 degrees is at r / sqrt(2) from the centre, towards the
// lamp.
TEST(SpherePainter, PlacesTheHighlight) {
  const PaintedLight light = painted({sphere_at({0, 0, 0}, kRadius_mm)}, side_led());
  const double offset_px = kRadius_mm / std::numbers::sqrt2 * kFocal_px / kDistance_mm;
  EXPECT_NEAR(light.centroid_px.x(), 31.5 + offset_px, 0.3);
  EXPECT_NEAR(light.centroid_px.y(), 31.5, 0.05);
}

// A sphere between the lamp and another takes its light; out of the camera's sight it adds none.
TEST(SpherePainter, SpheresShadowEachOther) {
  const calib::MirrorSphere seen = sphere_at({0, 0, 0}, kRadius_mm);
  const double alone = painted({seen}, side_led()).sum;
  const double shadowed = painted({seen, sphere_at({300, 0, 0}, 60.0)}, side_led()).sum;
  EXPECT_LT(shadowed, 0.01 * alone);
}

// A point has no image of any size: it is painted as a disc of kChipRadius_mm.
TEST(SpherePainter, PaintsAPointAsAChip) {
  Led point = side_led();
  point.position_mm = {40, 0, 0};
  point.radius_mm = 0.0;
  Led chip = point;
  chip.radius_mm = kChipRadius_mm;
  const std::vector<calib::MirrorSphere> spheres = {sphere_at({0, 0, 0}, kRadius_mm)};
  EXPECT_GT(painted(spheres, point).sum, 0.0);
  EXPECT_EQ(painted(spheres, point).sum, painted(spheres, chip).sum);
}

}  // namespace
}  // namespace scattermeter::apps
