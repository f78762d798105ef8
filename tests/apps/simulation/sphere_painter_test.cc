#include "apps/simulation/sphere_painter.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/apps/overhead_view.h"

namespace scattermeter::apps {
namespace {

class SpherePainter : public ::testing::Test {
 protected:
  SpherePainter() {
    led_.position_mm = {60, 0, 120};
    led_.axis = -led_.position_mm.normalized();
    led_.intensity_W_per_sr = {2, 2, 2};
  }
  std::vector<float> painted() const {
    RadianceCanvas canvas(CfaPattern{}, view_);
    paint_spheres(spheres_, led_, view_, canvas);
    return canvas.pixels;
  }
  Eigen::Vector2d image_px(const Eigen::Vector3d& p) const {
    return project(view_.intrinsics, view_.camera_from_world, {p}).front();
  }
  // The brightest of the 5 x 5 pixels about a point's image.
  float brightest_at(const std::vector<float>& pixels, const Eigen::Vector3d& p) const {
    const Eigen::Vector2d at = image_px(p);
    float most = 0.0F;
    for (int y = -2; y <= 2; ++y) {
      for (int x = -2; x <= 2; ++x) {
        most = std::max(most, pixels[static_cast<std::size_t>(std::lround(at.y()) + y) * 240U +
                                     static_cast<std::size_t>(std::lround(at.x()) + x)]);
      }
    }
    return most;
  }
  CameraView view_ = overhead_view(0, 0);
  Led led_;
  std::vector<calib::MirrorSphere> spheres_;
};

// Where Alhazen's point is seen, and as bright as a convex mirror makes it: a bundle from distance
// s that meets the sphere at an angle i leaves it as from s / (1 + 2 s / (R cos i)) in the plane of
// incidence and s / (1 + 2 s cos i / R) across (Coddington's equations).
TEST_F(SpherePainter, HighlightHasItsPositionAndItsPower) {
  view_.intrinsics.fx_px = view_.intrinsics.fy_px = 1200;
  led_.radius_mm = 4.0;
  spheres_ = {{{3, -2, 8}, 8.0, 0.0, 0.0}};
  const std::vector<float> seen = painted();
  const Eigen::Vector3d eye = view_.center_in_world_mm();
  const auto point = calib::mirror_point_mm(spheres_[0], eye, led_.position_mm);
  ASSERT_TRUE(point.has_value());
  const Eigen::Vector2d at = image_px(*point);
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
  const Eigen::Vector3d normal = (*point - spheres_[0].center_mm).normalized();
  const Eigen::Vector3d to_led = led_.position_mm - *point;
  const double s = to_led.norm();
  const double cos_i = normal.dot(to_led.normalized());
  const double d = (eye - *point).norm();
  const double lobe = -led_.axis.dot(to_led.normalized());
  const double irradiance =
      kMirrorReflectance * 2.0 * lobe / (s * s) /
      ((1.0 + d * (1.0 / s + 2.0 / (8.0 * cos_i))) * (1.0 + d * (1.0 / s + 2.0 * cos_i / 8.0)));
  // Radiance over the pixels' solid angle; a pixel off the axis by t is smaller by cos^3 t.
  const double cos_t = (eye - *point).normalized().z();
  EXPECT_NEAR(sum * std::pow(cos_t, 3.0) / (1200.0 * 1200.0), irradiance, 0.02 * irradiance);
}

// One sphere in front of another, seen from the LED: its highlight is gone.
TEST_F(SpherePainter, SpheresHideTheLed) {
  led_.radius_mm = 2.0;
  spheres_ = {{{0, 0, 8}, 8.0, 0.0, 0.0}};
  const Eigen::Vector3d eye = view_.center_in_world_mm();
  const auto point = calib::mirror_point_mm(spheres_[0], eye, led_.position_mm);
  const float alone = brightest_at(painted(), *point);
  // Half way to the LED.
  calib::MirrorSphere other;
  other.center_mm = 0.5 * (*point + led_.position_mm);
  other.radius_mm = 3.0;
  spheres_.push_back(other);
  const auto second = calib::mirror_point_mm(other, eye, led_.position_mm);
  ASSERT_TRUE(second.has_value());
  const std::vector<float> seen = painted();
  EXPECT_LT(brightest_at(seen, *point), 0.01F * alone);
  EXPECT_GT(brightest_at(seen, *second), 0.01F * alone);
}

// Off the highlight a sphere shows its base: albedo / pi times the LED's irradiance.
TEST_F(SpherePainter, TheBaseIsDiffuse) {
  led_.position_mm = {0, 0, 300};
  led_.axis = -Eigen::Vector3d::UnitZ();
  led_.radius_mm = 1.0;
  spheres_ = {{{0, 0, 30}, 30.0, 0.0, 0.0}};
  const std::vector<float> seen = painted();
  // On the sphere's upper half, 40 degrees from its top.
  const double angle = 40.0 * M_PI / 180.0;
  const Eigen::Vector3d normal(std::sin(angle), 0, std::cos(angle));
  const Eigen::Vector3d p = spheres_[0].center_mm + 30.0 * normal;
  const Eigen::Vector2d at = image_px(p);
  const double value =
      seen[static_cast<std::size_t>(std::lround(at.y()) * 240 + std::lround(at.x()))];
  const double expected =
      kMirrorBaseAlbedo / M_PI * 2.0 * led_.transmitted_irradiance_per_mm2(p, normal, 1.0);
  EXPECT_NEAR(value, expected, 0.03 * expected);  // within half a pixel
  EXPECT_EQ(seen[0], 0.0F);
}

}  // namespace
}  // namespace scattermeter::apps
