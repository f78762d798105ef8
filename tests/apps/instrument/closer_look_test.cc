#include "apps/instrument/closer_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/mesh/bodies.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// A cube under two LEDs, which stands elsewhere in the shots than its mesh.
class CloserLookTest : public ::testing::Test {
 protected:
  CloserLookTest()
      : rig_(bodies_rig(480, 1.4, {{"m", plastic()}}, {"cube"})), scenes_(bodies_scenes(rig_)) {
    rig_.pose.options.point_std_px = 0.2;
    pose_ = calib::pose_from_points(rig_.scene, rig_.pose);
  }
  capture::ShotSource shots(const Eigen::Vector3d& moved_mm) {
    moved_ = open_objects(rig_, [&](const SceneObject& object) {
      TriangleMesh mesh = body_mesh(object.name);
      for (Eigen::Vector3d& v : mesh.vertices_mm) v += moved_mm;
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

TEST_F(CloserLookTest, APoseThatTheOutlinesContradictIsAFinding) {
  OutlineFindings outlines;
  outlines.notes = {"note"};
  outlines.prior = pose_;
  outlines.pose = pose_;
  outlines.diagnosis.emplace().shift_px = {3.2, -0.4};
  const capture::ShotSource off = shots({0.7, 0, 0});
  outlines.looked_at = off.shot_idxs;
  pose_with_outlines(rig_, scenes_, off, outlines);
  ASSERT_EQ(outlines.findings.size(), 1U);
  EXPECT_THAT(outlines.findings[0].text,
              HasSubstr("which are 3.2 px right and 0.4 px high of where it puts them"));
  EXPECT_TRUE(outlines.notes.empty());
}

TEST_F(CloserLookTest, APoseWithinItsUncertaintyIsImproved) {
  OutlineFindings outlines;
  outlines.prior = pose_;
  outlines.prior->covariance.diagonal().tail<3>().array() += 0.04;
  outlines.pose = pose_;
  outlines.diagnosis.emplace();
  const PoseResult better = pose_with_outlines(rig_, scenes_, shots({0.1, 0, 0}), outlines);
  EXPECT_TRUE(outlines.findings.empty());
  const Eigen::Vector3d center = scenes_.at("cube").box.center_mm();
  const Eigen::Vector3d moved = center + Eigen::Vector3d(0.1, 0, 0);
  const Eigen::Vector2d seen = (better.camera_from_world * center).hnormalized();
  const Eigen::Vector2d true_place = (pose_.camera_from_world * moved).hnormalized();
  EXPECT_LT((seen - true_place).norm() * rig_.scene.camera.intrinsics.fx_px, 0.15);
}

}  // namespace
}  // namespace scattermeter::apps
