#include "apps/silhouette_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "apps/camera_view.h"
#include "apps/shot_pose.h"
#include "apps/virtual_shots.h"
#include "tests/apps/charuco_rig.h"
#include "tests/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

// Cube and pyramid under two LEDs; the truth may differ from the rig.
class SilhouetteCheckTest : public ::testing::Test {
 protected:
  SilhouetteCheckTest() {
    files_.keep_shots("PP_");
    rig_ = read_rig(files_.rig());
    scenes_ = open_objects(rig_);
    truth_ = rig_;
    truth_.truth_pose = RigTruthPose{{0, -100, 150}, {0, 0, 9}};
  }

  SilhouetteCheck checked(double cube_scale = 1.0) {
    const ObjectScenes true_scenes = open_objects(truth_, [&](const RigObject& object) {
      TriangleMesh mesh = scenes_.at(object.name).mesh();
      for (Eigen::Vector3d& v : mesh.vertices_mm) v *= object.name == "cube" ? cube_scale : 1.0;
      return mesh;
    });
    const VirtualShots shots(truth_, true_scenes, {.noise = true, .quiet = true});
    return check_silhouettes(
        rig_, scenes_, [&](std::size_t i, std::size_t k) { return shots.frame(i, seed_, k); },
        all_shots(rig_), pose_from_points(rig_));
  }

  SmallRig files_;
  Rig rig_;
  Rig truth_;
  ObjectScenes scenes_;
  std::uint64_t seed_ = 1;
};

TEST_F(SilhouetteCheckTest, GoodRig) {
  const SilhouetteCheck c = checked();
  EXPECT_TRUE(c.passed()) << c.verdict();
  EXPECT_EQ(c.shots_found, 4U);
  EXPECT_LT(c.rms_px, 0.05);
}

// Turned about the vertical by 1 degree as the object sees it: 21 px.
TEST_F(SilhouetteCheckTest, CameraKnocked) {
  truth_.truth_pose->look_at_mm.x() = 3.0;
  const SilhouetteCheck c = checked();
  EXPECT_FALSE(c.passed());
  EXPECT_FALSE(c.drifts) << c.verdict();
  EXPECT_EQ(c.diagnosis.cause, calib::EdgeCause::kCameraTurned) << c.verdict();
  EXPECT_GT(c.worst_px, 15);
}

TEST_F(SilhouetteCheckTest, WrongScale) {
  const SilhouetteCheck c = checked(1.015);
  EXPECT_FALSE(c.passed());
  EXPECT_EQ(c.diagnosis.cause, calib::EdgeCause::kMeshScale) << c.verdict();
  EXPECT_EQ(c.diagnosis.body_idx, 0);
}

TEST_F(SilhouetteCheckTest, FocusChanged) {
  truth_.camera.intrinsics.fx_px *= 1.01;
  truth_.camera.intrinsics.fy_px *= 1.01;
  truth_.camera.intrinsics.distortion = {-0.1, 0, 0, 0};
  const SilhouetteCheck c = checked();
  EXPECT_FALSE(c.passed());
  EXPECT_EQ(c.diagnosis.cause, calib::EdgeCause::kFocalLength) << c.verdict();
}

// Between the first and the second shot of the pyramid the camera slips by 0.3 mm: 2 px.
TEST_F(SilhouetteCheckTest, CameraDrifts) {
  const VirtualShots before(truth_, scenes_, {.noise = true, .quiet = true});
  Rig later = truth_;
  later.truth_pose->position_mm.x() += 0.3;
  later.truth_pose->look_at_mm.x() += 0.3;
  const VirtualShots after(later, scenes_, {.noise = true, .quiet = true});
  const SilhouetteCheck c = check_silhouettes(
      rig_, scenes_,
      [&](std::size_t i, std::size_t k) {
        return i == 3 ? after.frame(i, 1, k) : before.frame(i, 1, k);
      },
      all_shots(rig_), pose_from_points(rig_));
  EXPECT_FALSE(c.passed());
  EXPECT_TRUE(c.drifts);
  EXPECT_NEAR(c.drift_px, 2.1, 0.5);
  EXPECT_NE(c.verdict().find("PP_pyramid_2.dng"), std::string::npos) << c.verdict();
}

// The outline before paper and ink.
class BoardInTheShotTest : public ::testing::Test {
 protected:
  BoardInTheShotTest() {
    rig_ = read_rig(files_.rig());
    scenes_ = open_objects(rig_);
  }

  SilhouetteCheck checked(double scale) const {
    const ObjectScenes true_scenes = open_objects(rig_, [&](const RigObject& object) {
      TriangleMesh mesh = scenes_.at(object.name).mesh();
      for (Eigen::Vector3d& v : mesh.vertices_mm) v *= scale;
      return mesh;
    });
    const VirtualShots shots(rig_, true_scenes, {.noise = true, .quiet = true});
    std::vector<calib::PoseResult> poses;
    const std::vector<std::size_t> idxs = all_shots(rig_);
    for (const std::size_t i : idxs) {
      poses.push_back(pose_from_board(rig_, shots.frame(i, 1), rig_.shots[i].file));
    }
    return check_silhouettes_apart(
        rig_, scenes_,
        [&](std::size_t i, std::size_t exposure) { return shots.frame(i, 1, exposure); }, idxs,
        poses);
  }

  CharucoRig files_{"PE_pyramid"};
  Rig rig_;
  ObjectScenes scenes_;
};

TEST_F(BoardInTheShotTest, GoodRigPasses) {
  const SilhouetteCheck c = checked(1.0);
  ASSERT_EQ(c.shots_found, 2U) << c.verdict();
  EXPECT_TRUE(c.passed()) << c.verdict();
  // The board alone leaves the top of the body some tenths of a pixel; within what it knows of the
  // pose the outline fits as that of a rig with marks.
  ASSERT_FALSE(c.diagnosis.explanations.empty());
  EXPECT_LT(c.diagnosis.explanations.front().rms_px, 0.15);
  RecordProperty("rms_px", std::to_string(c.rms_px));
  RecordProperty("pieces", std::to_string(c.shots[0].pieces));
}

// pose.refine: silhouette, before a board.
TEST_F(BoardInTheShotTest, TheOutlineRefinesTheBoardsPose) {
  const VirtualShots shots(rig_, scenes_, {.noise = true, .quiet = true});
  const std::string& file = rig_.shots[0].file;
  const calib::PoseResult board = pose_from_board(rig_, shots.frame(0, 1), file);
  const calib::PoseResult both =
      pose_from_silhouette(rig_, scenes_, board, 0, shots.frame(0, 1), file);
  EXPECT_LT(both.center_std_mm.norm(), board.center_std_mm.norm());
  const Eigen::Vector3d off =
      inverse(both.camera_from_world).translation_mm - Eigen::Vector3d(0, -100, 150);
  EXPECT_LT(off.norm(), 4.0 * both.center_std_mm.norm());
}

// 2 % of 20 mm at 13 px/mm: 3 px and less.
TEST_F(BoardInTheShotTest, WrongScaleIsFound) {
  const SilhouetteCheck c = checked(1.02);
  ASSERT_GT(c.shots_found, 0U) << c.verdict();
  EXPECT_FALSE(c.passed()) << c.verdict();
  EXPECT_GT(c.rms_px, 0.5);
  const auto scaled = [](const calib::EdgeExplanation& e) {
    return (e.cause == calib::EdgeCause::kMeshScale ||
            e.cause == calib::EdgeCause::kAllMeshScales) &&
           std::abs(std::abs(e.value) - 0.02) < 0.005;
  };
  EXPECT_TRUE(std::any_of(c.diagnosis.explanations.begin(), c.diagnosis.explanations.end(), scaled))
      << c.verdict();
  EXPECT_NE(c.verdict().find(".dng"), std::string::npos) << c.verdict();
  EXPECT_THROW(check_silhouettes_apart(rig_, scenes_, {}, {0}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
