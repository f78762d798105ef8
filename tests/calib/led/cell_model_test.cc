#include "calib/led/cell_model.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/led_scenes.h"

namespace scattermeter::calib {
namespace {

TEST(CellModel, RadianceIsLambertsLaw) {
  LedScene scene = draw_led_scene(true_led(), {}, 1);
  ShadedCell cell = scene.cells[10];
  cell.spread_mm2.setIdentity();
  cell.spread_mm2 *= 1e-8;
  const WhitePlane& plane = scene.planes[0];
  const Eigen::Vector3d point =
      plane.origin_mm + Eigen::Vector3d(cell.on_plane_mm.x(), cell.on_plane_mm.y(), 0.0);
  const Led led = true_led();
  const double expected = plane.albedo[cell.channel] / std::numbers::pi *
                          led.intensity_W_per_sr[cell.channel] *
                          led.transmitted_irradiance_per_mm2(point, plane.normal(), 1.0);
  EXPECT_NEAR(cell_radiance(scene, cell, led) / expected, 1.0, 1e-9);
}

// What a nuisance of one deviation does: the albedo and the exposure scale the radiance, the pose
// moves the points that the cell's rays meet.
TEST(CellModel, NuisancesAreInUnitsOfTheirPriors) {
  LedScene scene = draw_led_scene(true_led(), {}, 1);
  scene.planes[0].albedo_relative_std = 0.02;
  scene.exposure_relative_std = {0.03};
  const LedFrame frame(scene, true_led());
  const CellModel model(frame, scene.cells[25]);
  const auto x = frame.start();
  std::array<double, 6> pose{};
  const double none = 0.0, one = 1.0, two = 2.0;
  const double nominal = model.radiance(x.data(), pose.data(), &none, &none);
  EXPECT_DOUBLE_EQ(nominal, cell_radiance(scene, scene.cells[25], true_led()));
  EXPECT_NEAR(model.radiance(x.data(), pose.data(), &one, &none) / nominal, 1.02, 1e-12);
  EXPECT_NEAR(model.radiance(x.data(), pose.data(), &none, &two) / nominal, 1.06, 1e-12);
  // 0.003 mm of 100 mm: a small change, and not none.
  pose[3] = 1.0;
  const double moved = model.radiance(x.data(), pose.data(), &none, &none);
  EXPECT_NE(moved, nominal);
  EXPECT_NEAR(moved / nominal, 1.0, 1e-3);
}

// The mean over a disc of radius a, at distance d on its axis and a point of the plane right below:
// to the second order the mean over the ring of radius a / sqrt 2.
TEST(CellModel, ADiscIsItsRing) {
  LedScene scene;
  scene.intrinsics = led_camera();
  scene.views.push_back({led_camera_pose(), Eigen::Matrix<double, 6, 6>::Zero()});
  WhitePlane plane;
  plane.width_mm = plane.height_mm = 10;
  scene.planes = {plane};
  ShadedCell cell;
  cell.on_plane_mm = {5, 5};
  cell.spread_mm2 = 1e-12 * Eigen::Matrix2d::Identity();
  cell.radiance_W_per_mm2_sr = cell.std_W_per_mm2_sr = 1.0;
  scene.cells = {cell};
  Led led;
  led.position_mm = {5, 5, 40};
  led.exponent = 2.0;
  const double albedo = plane.albedo[0];
  EXPECT_NEAR(cell_radiance(scene, cell, led), albedo / std::numbers::pi / 1600.0, 1e-12);
  led.radius_mm = 4.0;
  const double r2 = 1600.0 + 8.0;
  const double cosine = 40.0 / std::sqrt(r2);
  EXPECT_NEAR(cell_radiance(scene, cell, led), albedo / std::numbers::pi * std::pow(cosine, 3) / r2,
              1e-12);
}

TEST(CellModel, BehindThePlaneIsDark) {
  LedScene scene = draw_led_scene(true_led(), {}, 1);
  Led led = true_led();
  led.position_mm.z() = -80;
  EXPECT_EQ(cell_radiance(scene, scene.cells[0], led), 0.0);
  led = true_led();
  led.axis = -led.axis;
  EXPECT_EQ(cell_radiance(scene, scene.cells[0], led), 0.0);
}

}  // namespace
}  // namespace scattermeter::calib
