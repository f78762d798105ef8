#include "apps/instrument/rig_places.h"

#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "core/camera/camera_model.h"
#include "core/view/camera_view.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

class RigPlacesTest : public ::testing::Test {
 protected:
  RigPlacesTest() {
    files_.keep_shots("PE_cube");
    rig_ = read_rig(files_.rig());
    objects_ = open_objects(rig_);
    ObservedShot shot;
    shot.stated = &rig_.scene.shots[0];
    shot.pose.camera_from_world = look_at({0, -100, 150}, {0, 0, 9}, Eigen::Vector3d::UnitZ());
    shot.pose.center_std_mm = {0.1, 0.2, 0.3};
    shots_.assign(2, shot);
  }
  SmallRig files_;
  Rig rig_;
  ObjectScenes objects_;
  std::vector<ObservedShot> shots_;
};

TEST_F(RigPlacesTest, OneCameraWhereItDoesNotMove) {
  const RigPlaces places = rig_places(rig_, objects_, shots_);
  ASSERT_EQ(places.cameras.size(), 1U);
  EXPECT_EQ(places.cameras[0].name, "camera");
  EXPECT_NEAR((places.cameras[0].center_mm - Eigen::Vector3d(0, -100, 150)).norm(), 0.0, 1e-9);
  // What lies in the direction of the upper left corner is seen there.
  const Eigen::Vector3d far = places.cameras[0].center_mm + 200.0 * places.cameras[0].corners[0];
  const Eigen::Vector2d seen =
      project(rig_.scene.camera.intrinsics, shots_[0].pose.camera_from_world, {far}).front();
  EXPECT_NEAR((seen - Eigen::Vector2d(-0.5, -0.5)).norm(), 0.0, 1e-4);
  ASSERT_EQ(places.leds.size(), 2U);
  EXPECT_EQ(places.leds[0].position_mm, rig_.scene.light("led1").led()->led.position_mm);
  EXPECT_EQ(places.leds[0].position_std_mm, rig_.scene.light("led1").led()->position_std_mm);
  ASSERT_EQ(places.bodies.size(), 1U);
  EXPECT_EQ(places.bodies[0].mesh.triangles.size(), objects_.at("cube").mesh().triangles.size());
  EXPECT_EQ(places.marks.size(), rig_.pose.points.size());
  EXPECT_FALSE(places.board.has_value());
  EXPECT_FALSE(places.plane_z_mm.has_value());
}

TEST_F(RigPlacesTest, ACameraOfEachShotAndABoard) {
  for (ObservedShot& shot : shots_) shot.has_own_pose = true;
  rig_.pose.charuco = calib::CharucoBoard{5, 7, 10.0, 7.0, "DICT_4X4_50", {}};
  rig_.pose.charuco->world_from_board.translation_mm = {1, 2, 3};
  rig_.scene.surroundings.plane = ScenePlane{-4.0};
  const RigPlaces places = rig_places(rig_, objects_, shots_);
  ASSERT_EQ(places.cameras.size(), 2U);
  EXPECT_EQ(places.cameras[1].name, shots_[1].stated->file);
  EXPECT_EQ(places.board->at(2), Eigen::Vector3d(51, 72, 3));
  EXPECT_EQ(places.plane_z_mm, -4.0);
}

}  // namespace
}  // namespace scattermeter::apps
