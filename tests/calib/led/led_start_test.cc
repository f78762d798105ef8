#include "calib/led/led_start.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/led_scenes.h"

namespace scattermeter::calib {
namespace {

LedSceneOptions only_spheres() {
  LedSceneOptions options;
  options.planes = 0;
  return options;
}

TEST(LedStart, FindsTheLedWithoutBeingTold) {
  const LedScene scene = draw_led_scene(true_led(), only_spheres(), 1);
  const auto start = led_start(scene, 3.0);
  ASSERT_TRUE(start);
  EXPECT_LT((start->position_mm - true_led().position_mm).norm(), 0.5);
  EXPECT_EQ(std::count(start->agrees.begin(), start->agrees.end(), true), 5);
}

TEST(LedStart, LeavesFalseHighlightsOut) {
  LedScene scene = draw_led_scene(true_led(), only_spheres(), 2);
  scene.highlights[0].image_px += Eigen::Vector2d(20, 8);
  scene.highlights[3].image_px += Eigen::Vector2d(-11, 14);
  const auto start = led_start(scene, 3.0);
  ASSERT_TRUE(start);
  EXPECT_LT((start->position_mm - true_led().position_mm).norm(), 1.0);
  EXPECT_EQ(start->agrees, (std::vector<bool>{false, true, true, false, true}));
}

TEST(LedStart, NoneFromOneSphere) {
  LedScene scene = draw_led_scene(true_led(), only_spheres(), 3);
  scene.highlights.resize(1);
  EXPECT_FALSE(led_start(scene, 3.0));
}

// The image of a disc's middle, against the mean over many points.
TEST(LedStart, DiscIsSeenAtItsMeanPlace) {
  const Lens lens(led_camera());
  const MirrorSphere sphere{{-24, -12, 8}, 8.0};
  Led led = true_led();
  led.radius_mm = 4.0;
  const Eigen::Vector2d disc = highlight_px(lens, led_camera_pose(), sphere, led);
  const Eigen::Vector3d u = led.axis.unitOrthogonal();
  const Eigen::Vector3d v = led.axis.cross(u);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  int n = 0;
  for (double x = -3.95; x < 4.0; x += 0.1) {
    for (double y = -3.95; y < 4.0; y += 0.1) {
      if (x * x + y * y > 16.0) continue;
      Led point = led;
      point.radius_mm = 0.0;
      point.position_mm += x * u + y * v;
      mean += highlight_px(lens, led_camera_pose(), sphere, point);
      ++n;
    }
  }
  EXPECT_LT((disc - mean / n).norm(), 1e-3);
}

}  // namespace
}  // namespace scattermeter::calib
