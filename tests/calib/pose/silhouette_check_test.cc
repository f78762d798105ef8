#include "calib/pose/silhouette_check.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "core/view/camera_view.h"
#include "tests/fixtures/apps/charuco_rig.h"
#include "tests/fixtures/apps/small_rig.h"

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
    truth_.truth.pose = CameraPlacement{{0, -100, 150}, {0, 0, 9}};
  }

  calib::SilhouetteCheck checked(double cube_scale = 1.0) {
    const ObjectScenes true_scenes = open_objects(truth_, [&](const SceneObject& object) {
      TriangleMesh mesh = scenes_.at(object.name).mesh();
      for (Eigen::Vector3d& v : mesh.vertices_mm) v *= object.name == "cube" ? cube_scale : 1.0;
      return mesh;
    });
    const VirtualShots shots(truth_, true_scenes, {.noise = true});
    return calib::check_silhouettes(
        rig_.scene, rig_.pose, scenes_,
        [&](std::size_t i, std::size_t k) { return shots.frame(i, seed_, k); },
        capture::all_shots(rig_.scene), calib::pose_from_points(rig_.scene, rig_.pose));
  }

  SmallRig files_;
  Rig rig_;
  Rig truth_;
  ObjectScenes scenes_;
  std::uint64_t seed_ = 1;
};

TEST_F(SilhouetteCheckTest, GoodRig) {
  const calib::SilhouetteCheck c = checked();
  EXPECT_TRUE(c.passed()) << c.verdict();
  EXPECT_EQ(c.shots_found, 4U);
  EXPECT_LT(c.rms_px, 0.05);
}

// Turned about the vertical by 1 degree as the object sees it: 21 px.
TEST_F(SilhouetteCheckTest, CameraKnocked) {
  truth_.truth.pose->look_at_mm.x() = 3.0;
  const calib::SilhouetteCheck c = checked();
  EXPECT_FALSE(c.passed());
  EXPECT_FALSE(c.drifts) << c.verdict();
  EXPECT_EQ(c.diagnosis.cause, calib::EdgeCause::kCameraTurned) << c.verdict();
  EXPECT_GT(c.worst_px, 15);
}

TEST_F(SilhouetteCheckTest, WrongScale) {
  const calib::SilhouetteCheck c = checked(1.015);
  EXPECT_FALSE(c.passed());
  EXPECT_EQ(c.diagnosis.cause, calib::EdgeCause::kMeshScale) << c.verdict();
  EXPECT_EQ(c.diagnosis.body_idx, 0);
}

TEST_F(SilhouetteCheckTest, FocusChanged) {
  truth_.scene.camera.intrinsics.fx_px *= 1.01;
  truth_.scene.camera.intrinsics.fy_px *= 1.01;
  truth_.scene.camera.intrinsics.distortion = {-0.1, 0, 0, 0};
  const calib::SilhouetteCheck c = checked();
  EXPECT_FALSE(c.passed());
  EXPECT_EQ(c.diagnosis.cause, calib::EdgeCause::kFocalLength) << c.verdict();
}

// Between the first and the second shot of the pyramid the camera slips by 0.3 mm: 2 px.
TEST_F(SilhouetteCheckTest, CameraDrifts) {
  const VirtualShots before(truth_, scenes_, {.noise = true});
  Rig later = truth_;
  later.truth.pose->position_mm.x() += 0.3;
  later.truth.pose->look_at_mm.x() += 0.3;
  const VirtualShots after(later, scenes_, {.noise = true});
  const calib::SilhouetteCheck c = calib::check_silhouettes(
      rig_.scene, rig_.pose, scenes_,
      [&](std::size_t i, std::size_t k) {
        return i == 3 ? after.frame(i, 1, k) : before.frame(i, 1, k);
      },
      capture::all_shots(rig_.scene), calib::pose_from_points(rig_.scene, rig_.pose));
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

  calib::SilhouetteCheck checked(double scale) const {
    const ObjectScenes true_scenes = open_objects(rig_, [&](const SceneObject& object) {
      TriangleMesh mesh = scenes_.at(object.name).mesh();
      for (Eigen::Vector3d& v : mesh.vertices_mm) v *= scale;
      return mesh;
    });
    const VirtualShots shots(rig_, true_scenes, {.noise = true});
    std::vector<PoseResult> poses;
    const std::vector<std::size_t> idxs = capture::all_shots(rig_.scene);
    for (const std::size_t i : idxs) {
      poses.push_back(calib::pose_from_board(rig_.scene, rig_.pose, shots.frame(i, 1),
                                             rig_.scene.shots[i].file));
    }
    return calib::check_silhouettes_apart(
        rig_.scene, rig_.pose, scenes_,
        [&](std::size_t i, std::size_t exposure) { return shots.frame(i, 1, exposure); }, idxs,
        poses);
  }

  CharucoRig files_{"PE_pyramid"};
  Rig rig_;
  ObjectScenes scenes_;
};

TEST_F(BoardInTheShotTest, GoodRigPasses) {
  const calib::SilhouetteCheck c = checked(1.0);
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
  const VirtualShots shots(rig_, scenes_, {.noise = true});
  const std::string& file = rig_.scene.shots[0].file;
  const PoseResult board = calib::pose_from_board(rig_.scene, rig_.pose, shots.frame(0, 1), file);
  const PoseResult both = calib::pose_from_silhouette(rig_.scene, rig_.pose, scenes_, board, 0,
                                                      shots.frame(0, 1), file);
  EXPECT_LT(both.center_std_mm.norm(), board.center_std_mm.norm());
  const Eigen::Vector3d off =
      inverse(both.camera_from_world).translation_mm - Eigen::Vector3d(0, -100, 150);
  EXPECT_LT(off.norm(), 4.0 * both.center_std_mm.norm());
}

// 2 % of 20 mm at 13 px/mm: 3 px and less.
TEST_F(BoardInTheShotTest, WrongScaleIsFound) {
  const calib::SilhouetteCheck c = checked(1.02);
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
  EXPECT_THROW(calib::check_silhouettes_apart(rig_.scene, rig_.pose, scenes_, {}, {0}, {}),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
