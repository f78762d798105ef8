#include "apps/simulation/led_picture.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

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

// Where Alhazen's point is seen, and as bright as a convex mirror makes it: a bundle from distance
// s that meets the sphere at an angle i leaves it as from s / (1 + 2 s / (R cos i)) in the plane of
// incidence and s / (1 + 2 s cos i / R) across (Coddington's equations).
TEST_F(LedPicture, HighlightHasItsPlaceAndItsPower) {
  view_.intrinsics.fx_px = view_.intrinsics.fy_px = 1200;
  rig_.scene.camera.intrinsics = view_.intrinsics;
  led().radius_mm = 4.0;
  led().intensity_W_per_sr = {2, 2, 2};
  shots().spheres = {{{3, -2, 8}, 8.0, 0.0, 0.0}};
  const std::vector<float> seen = picture(LedShotKind::kSpheres);
  const Eigen::Vector3d eye = view_.center_in_world_mm();
  const auto point = calib::mirror_point_mm(shots().spheres[0], eye, led().position_mm);
  ASSERT_TRUE(point.has_value());
  const Eigen::Vector2d at = project(view_.intrinsics, view_.camera_from_world, {*point}).front();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  double sum = 0.0;
  for (int y = static_cast<int>(at.y()) - 8; y <= static_cast<int>(at.y()) + 9; ++y) {
    for (int x = static_cast<int>(at.x()) - 8; x <= static_cast<int>(at.x()) + 9; ++x) {
      const double value = seen[static_cast<std::size_t>(y * 240 + x)];
      sum += value;
      moment += value * Eigen::Vector2d(x, y);
    }
  }
  EXPECT_NEAR((moment / sum - at).norm(), 0.0, 0.05);
  const Eigen::Vector3d normal = (*point - shots().spheres[0].center_mm).normalized();
  const Eigen::Vector3d to_led = led().position_mm - *point;
  const double s = to_led.norm();
  const double cos_i = normal.dot(to_led.normalized());
  const double d = (eye - *point).norm();
  const double lobe = -led().axis.dot(to_led.normalized());
  const double irradiance =
      kMirrorReflectance * 2.0 * lobe / (s * s) /
      ((1.0 + d * (1.0 / s + 2.0 / (8.0 * cos_i))) * (1.0 + d * (1.0 / s + 2.0 * cos_i / 8.0)));
  // Radiance over the pixels' solid angle; a pixel off the axis by t is smaller by cos^3 t.
  const double cos_t = (eye - *point).normalized().z();
  EXPECT_NEAR(sum * std::pow(cos_t, 3.0) / (1200.0 * 1200.0), irradiance, 0.02 * irradiance);
}

// One sphere in front of another, seen from the LED: its highlight is gone.
TEST_F(LedPicture, SpheresHideTheLed) {
  led().radius_mm = 2.0;
  shots().spheres = {{{0, 0, 8}, 8.0, 0.0, 0.0}};
  const auto brightest = [&] {
    const std::vector<float> seen = picture(LedShotKind::kSpheres);
    return *std::max_element(seen.begin(), seen.end());
  };
  const double alone = brightest();
  const auto point =
      calib::mirror_point_mm(shots().spheres[0], view_.center_in_world_mm(), led().position_mm);
  // Half way to the LED.
  calib::MirrorSphere other;
  other.center_mm = 0.5 * (*point + led().position_mm);
  other.radius_mm = 3.0;
  shots().spheres.push_back(other);
  const auto second = calib::mirror_point_mm(other, view_.center_in_world_mm(), led().position_mm);
  ASSERT_TRUE(second.has_value());
  const std::vector<float> seen = picture(LedShotKind::kSpheres);
  const auto around = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector2d at = project(view_.intrinsics, view_.camera_from_world, {p}).front();
    float most = 0.0F;
    for (int y = -2; y <= 2; ++y) {
      for (int x = -2; x <= 2; ++x) {
        most = std::max(most, seen[static_cast<std::size_t>(std::lround(at.y()) + y) * 240U +
                                   static_cast<std::size_t>(std::lround(at.x()) + x)]);
      }
    }
    return most;
  };
  EXPECT_LT(around(*point), 0.01 * alone);
  EXPECT_GT(around(*second), 0.01 * alone);
}

}  // namespace
}  // namespace scattermeter::apps
