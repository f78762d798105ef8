#include "apps/looks/closer_look.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

// A cube under two LEDs, which stands elsewhere in the shots than its mesh.
class CloserLookTest : public ::testing::Test {
 protected:
  CloserLookTest()
      : rig_(bodies_rig(480, 1.4, {{"m", plastic()}}, {"cube"})), scenes_(bodies_scenes(rig_)) {
    rig_.pose.options.point_std_px = 0.2;
    pose_ = calib::pose_from_points(rig_.scene, rig_.pose);
  }
  capture::ShotSource shots(const Eigen::Vector3d& moved_mm, double stretch_x = 1.0) {
    moved_ = open_objects(rig_, [&](const SceneObject& object) {
      TriangleMesh mesh = body_mesh(object.name);
      for (Eigen::Vector3d& v : mesh.vertices_mm) {
        v.x() *= stretch_x;
        v += moved_mm;
      }
      return mesh;
    });
    virtual_ = std::make_unique<VirtualShots>(rig_, moved_, VirtualShotOptions{.noise = true});
    return virtual_->source(1);
  }

  Rig rig_;
  ObjectScenes scenes_, moved_;
  PoseResult pose_;
  std::unique_ptr<VirtualShots> virtual_;
};

TEST_F(CloserLookTest, AgreesWithAGoodRigOnly) {
  const capture::ShotSource good = shots({0, 0, 0});
  EXPECT_TRUE(closer_look_agrees(rig_, scenes_, pose_, std::get<capture::FrameSource>(good.open),
                                 good.shot_idxs));
  const capture::ShotSource off = shots({0.7, 0, 0});
  EXPECT_FALSE(closer_look_agrees(rig_, scenes_, pose_, std::get<capture::FrameSource>(off.open),
                                  off.shot_idxs));
}

// A millimetre is some five pixels in this frame.
TEST_F(CloserLookTest, SaysHowFarTheOutlinesAreOff) {
  const auto said = [&](const capture::ShotSource& s) {
    return outline_departure(rig_, scenes_, pose_, std::get<capture::FrameSource>(s.open),
                             s.shot_idxs);
  };
  EXPECT_EQ(said(shots({0, 0, 0})), "");
  const std::string right = said(shots({0.7, 0, 0}));
  const double px = 0.7 * rig_.scene.camera.intrinsics.fx_px /
                    (pose_.camera_from_world * scenes_.at("cube").box.center_mm()).z();
  double said_px = 0.0;
  ASSERT_EQ(
      std::sscanf(right.c_str(), "pose or position: the outlines stand %lf px right", &said_px), 1)
      << right;
  EXPECT_NEAR(said_px, px, 0.5) << right;
}

// A cube that is narrower than its mesh has edges a few pixels off, on both sides.
TEST_F(CloserLookTest, TellsAnotherShapeFromAShift) {
  const capture::ShotSource narrow = shots({0, 0, 0}, 0.95);
  const std::string said = outline_departure(
      rig_, scenes_, pose_, std::get<capture::FrameSource>(narrow.open), narrow.shot_idxs);
  double px = 0.0;
  ASSERT_EQ(
      std::sscanf(said.c_str(), "shape or lens: the outlines depart by up to %lf px from", &px), 1)
      << said;
  const double half_mm = 0.5 * 0.05 * 20.0;
  EXPECT_LT(px, 2.0 * half_mm * px_per_mm(rig_.scene.camera.intrinsics, scenes_.at("cube"), pose_));
  EXPECT_GT(px, 1.0);
}

TEST(OutlineOptions, AreThoseOfTheLeastCertainObject) {
  Rig rig = bodies_rig(480, 1.4, {{"m", plastic()}}, {"cube", "pyramid"});
  for (SceneObject& object : rig.scene.objects) {
    object.position_std_mm = object.name == "cube" ? 0.0 : 0.4;
    object.scale_relative_std = object.name == "cube" ? 0.02 : 0.0;
    object.edge_std_mm = object.name == "cube" ? 0.3 : 0.0;
  }
  const ObjectScenes objects = bodies_scenes(rig);
  const PoseResult pose = calib::pose_from_points(rig.scene, rig.pose);
  EXPECT_EQ(quick_place_std_mm(objects.at("cube")), 0.1);
  EXPECT_EQ(quick_place_std_mm(objects.at("pyramid")), 0.4);
  const calib::OutlineOptions options = outline_options(rig, objects, pose);
  EXPECT_EQ(options.place_std_mm, 0.4);
  EXPECT_EQ(options.turn_std_rad, 0.4 / objects.at("pyramid").size_mm());
  EXPECT_EQ(options.scale_relative_std, 0.02);
  EXPECT_EQ(options.growth_std_px,
            edge_cut_px(rig.scene.camera.intrinsics, objects.at("cube"), pose));
  EXPECT_GT(options.growth_std_px, 0.0);
}

}  // namespace
}  // namespace scattermeter::apps
