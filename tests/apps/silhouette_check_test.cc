#include "apps/silhouette_check.h"

#include <gtest/gtest.h>

#include "apps/camera_view.h"
#include "apps/shot_pose.h"
#include "apps/virtual_shots.h"
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

}  // namespace
}  // namespace scattermeter::apps
