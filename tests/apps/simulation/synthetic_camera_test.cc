#include "apps/simulation/synthetic_camera.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "calib/pose/shot_pose.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {
namespace {

// As wide at the body, whatever the number of pixels.
TEST(SyntheticCamera, TheFrameIsOfOneSize) {
  for (const int width : {240, 969, 3872}) {
    Rig rig;
    set_up_camera(rig, width);
    const CameraIntrinsics& k = rig.scene.camera.intrinsics;
    EXPECT_EQ(k.width_px, width / 2 * 2);
    EXPECT_EQ(k.height_px % 2, 0);
    EXPECT_NEAR(pixel_mm(rig) * width, 71.0, 0.1);
    EXPECT_NEAR(static_cast<double>(k.width_px) / k.height_px, 3872.0 / 2592.0, 0.01);
    EXPECT_EQ(intrinsics_problem(k), "");
  }
  Rig rig;
  EXPECT_THROW(set_up_camera(rig, 239), std::invalid_argument);
  EXPECT_THROW(set_up_camera(rig, 3873), std::invalid_argument);
}

// A step of one pixel at the origin, at right angles to the line of sight, is pixel_mm.
TEST(SyntheticCamera, PixelOfTheOrigin) {
  Rig rig;
  set_up_camera(rig, 3872);
  rig.scene.camera.intrinsics.distortion.clear();
  const CameraPlacement& t = *rig.truth.pose;
  const Rigid3d pose = look_at(t.position_mm, {0, 0, 0}, t.up);
  const std::vector<Eigen::Vector2d> px =
      project(rig.scene.camera.intrinsics, pose, {{0, 0, 0}, {pixel_mm(rig), 0, 0}});
  EXPECT_NEAR((px[1] - px[0]).norm(), 1.0, 1e-9);
}

TEST(SyntheticCamera, ThePointsGiveThePose) {
  Rig rig;
  set_up_camera(rig, 968);
  const PoseResult pose = calib::pose_from_points(rig.scene, rig.pose);
  EXPECT_EQ(pose.status, PoseStatus::kOk);
  EXPECT_LT(pose.worst_px, 1e-6);
  EXPECT_NEAR((inverse(pose.camera_from_world).translation_mm - rig.truth.pose->position_mm).norm(),
              0.0, 1e-5);
  EXPECT_EQ(rig.scene.camera.responsivity_relative_std, 0.0);
}

TEST(SyntheticCamera, Led) {
  const SceneLight light = synthetic_led("lamp", {30, -60, 80}, {0, 3, -4});
  EXPECT_EQ(light.name, "lamp");
  ASSERT_NE(light.led(), nullptr);
  EXPECT_EQ(light.led()->led.position_mm, Eigen::Vector3d(30, -60, 80));
  EXPECT_NEAR((light.led()->led.axis - Eigen::Vector3d(0, 0.6, -0.8)).norm(), 0.0, 1e-15);
  EXPECT_EQ(light.led()->led.exponent, 1.0);
  EXPECT_EQ(light.led()->position_std_mm, 0.0);
  EXPECT_NEAR(light.led()->led.intensity_W_per_sr.mean(), 0.05, 0.001);
}

}  // namespace
}  // namespace scattermeter::apps
