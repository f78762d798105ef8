#include "calib/led/led_frame.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/led_scenes.h"

namespace scattermeter::calib {
namespace {

TEST(LedFrame, StartIsTheLed) {
  const LedScene scene = draw_led_scene(true_led(), {}, 1);
  const LedFrame frame(scene, true_led());
  const Led led = frame.at(frame.start().data());
  EXPECT_TRUE(led.position_mm.isApprox(true_led().position_mm, 1e-14));
  EXPECT_TRUE(led.axis.isApprox(true_led().axis, 1e-14));
  EXPECT_DOUBLE_EQ(led.exponent, true_led().exponent);
  EXPECT_TRUE(led.intensity_W_per_sr.isApprox(true_led().intensity_W_per_sr, 1e-14));
  EXPECT_EQ(led.radius_mm, true_led().radius_mm);
}

TEST(LedFrame, TheAxisStepsAlongItsTangents) {
  const LedScene scene = draw_led_scene(true_led(), {}, 1);
  const LedFrame frame(scene, true_led());
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(frame.tangents[k].norm(), 1.0, 1e-14);
    EXPECT_NEAR(frame.tangents[k].dot(true_led().axis), 0.0, 1e-14);
    auto x = frame.start();
    x[3 + k] = 0.1;
    const Led led = frame.at(x.data());
    EXPECT_NEAR(led.axis.norm(), 1.0, 1e-14);
    EXPECT_NEAR(led.axis.dot(frame.tangents[k]), 0.1 / std::hypot(1.0, 0.1), 1e-14);
    EXPECT_NEAR(led.axis.dot(frame.tangents[1 - k]), 0.0, 1e-14);
  }
}

TEST(LedFrame, ADarkChannelStaysDark) {
  Led led = true_led();
  led.intensity_W_per_sr[1] = 0.0;
  const LedScene scene = draw_led_scene(true_led(), {}, 1);
  const LedFrame frame(scene, led);
  auto x = frame.start();
  x[7] = 5.0;
  EXPECT_EQ(frame.at(x.data()).intensity_W_per_sr[1], 0.0);
}

TEST(LedFrame, AmbientUnitIsTheMeanOfTheCells) {
  LedScene scene;
  scene.intrinsics = led_camera();
  for (const double radiance : {2.0, 4.0}) {
    ShadedCell cell;
    cell.shot = 1;
    cell.channel = 2;
    cell.radiance_W_per_mm2_sr = radiance;
    scene.cells.push_back(cell);
  }
  const LedFrame frame(scene, true_led());
  ASSERT_EQ(frame.ambient_unit.size(), 2U);
  EXPECT_DOUBLE_EQ(frame.ambient_unit[1][2], 3.0);
  EXPECT_GT(frame.ambient_unit[0][0], 0.0);
}

TEST(LedFrame, PoseRootIsARootOfTheCovariance) {
  LedScene scene = draw_led_scene(true_led(), {}, 1);
  Eigen::Matrix<double, 6, 6>& c = scene.views[0].pose_covariance;
  c(0, 4) = c(4, 0) = 1e-7;
  const LedFrame frame(scene, true_led());
  EXPECT_TRUE((frame.pose_root[0] * frame.pose_root[0].transpose()).isApprox(c, 1e-12));
}

}  // namespace
}  // namespace scattermeter::calib
