#include "apps/simulation/led_picture.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "apps/simulation/sphere_painter.h"
#include "tests/fixtures/apps/overhead_view.h"

namespace scattermeter::apps {
namespace {

using calib::LedShotKind;

class LedPicture : public ::testing::Test {
 protected:
  LedPicture() {
    rig_.scene.camera.intrinsics = view_.intrinsics;
    SceneLight light;
    light.name = "led1";
    rig_.scene.lights = {light};
    led().position_mm = {60, 0, 120};
    led().axis = -led().position_mm.normalized();
    led().intensity_W_per_sr = {1, 2, 3};
    rig_.calibration.led.emplace();
  }
  Led& led() { return rig_.scene.lights[0].led()->led; }
  calib::LedCalibrationShots& shots() { return *rig_.calibration.led; }
  std::vector<float> picture(LedShotKind kind) const {
    calib::LedCalibrationShot shot;
    shot.kind = kind;
    if (kind != LedShotKind::kAmbient) shot.light = "led1";
    return led_picture(rig_, shot, view_);
  }
  Eigen::Index channel(int x, int y) const {
    return static_cast<Eigen::Index>(rig_.scene.camera.sensor.cfa.at(x, y));
  }
  void add_plane() {
    calib::WhitePlane plane;
    plane.origin_mm = {-40.25, -30.75, 0};
    plane.width_mm = 80.0;
    plane.height_mm = 60.0;
    plane.albedo = {0.9, 0.8, 0.7};
    shots().planes = {plane};
  }
  Rig rig_;
  CameraView view_ = overhead_view(0, 0);
};

// albedo / pi times I cos^n(axis) cos / r^2, plus what comes from elsewhere.
TEST_F(LedPicture, APlaneIsLambertian) {
  add_plane();
  led().exponent = 3.0;
  rig_.truth.ambient_irradiance_W_per_mm2 = {1e-6, 2e-6, 3e-6};
  const std::vector<float> seen = picture(LedShotKind::kPlane);
  int on_plane = 0;
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 240; ++x) {
      const Eigen::Vector3d p = overhead_point_mm(view_, x, y);
      const double inside = std::min(40.0 - std::abs(p.x() + 0.25), 30.0 - std::abs(p.y() + 0.75));
      if (std::abs(inside) < 2.0) continue;
      const double value = seen[static_cast<std::size_t>(y * 240 + x)];
      if (inside < 0.0) {
        ASSERT_EQ(value, 0.0);
        continue;
      }
      const Eigen::Vector3d to_led = led().position_mm - p;
      const Eigen::Index c = channel(x, y);
      const double irradiance = rig_.truth.ambient_irradiance_W_per_mm2[c] +
                                led().intensity_W_per_sr[c] *
                                    std::pow(-led().axis.dot(to_led.normalized()), 3.0) *
                                    to_led.normalized().z() / to_led.squaredNorm();
      const double expected = shots().planes[0].albedo[c] / std::numbers::pi * irradiance;
      ASSERT_NEAR(value, expected, 1e-5 * expected) << p.transpose();
      ++on_plane;
    }
  }
  EXPECT_GT(on_plane, 4000);
}

// With the LED off: even light, whose pixels add up to the plane's area.
TEST_F(LedPicture, BordersCountByTheirArea) {
  add_plane();
  shots().planes[0].albedo = {1, 1, 1};
  rig_.truth.ambient_irradiance_W_per_mm2 = {1, 1, 1};
  double area_mm2 = 0.0;
  for (const float value : picture(LedShotKind::kAmbient)) area_mm2 += std::numbers::pi * value;
  // 80 x 60 mm; a fifth of a pixel along the border is 56 mm^2, the rounding a tenth of it.
  EXPECT_NEAR(area_mm2, 4800.0, 15.0);
}

}  // namespace
}  // namespace scattermeter::apps
