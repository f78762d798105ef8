#include "core/nuisances/view_shift.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/camera/camera_model.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

class ViewShiftTest : public ::testing::Test {
 protected:
  ViewShiftTest() { cube_.shots[0].pose.covariance = pose_std_.cwiseAbs2().asDiagonal(); }
  const ObservedShot& shot() const { return cube_.shots[0]; }
  const Rigid3d& pose() const { return shot().pose.camera_from_world; }
  std::vector<Eigen::Vector2d> image(const CameraIntrinsics& lens, const Rigid3d& pose,
                                     double size = 1.0) const {
    const Eigen::Vector3d center = shot().seen->object->box.center_mm();
    std::vector<Eigen::Vector3d> points;
    for (const ExitSite& s : shot().seen->sites) {
      points.push_back(center + size * (s.center_mm - center));
    }
    return project(lens, pose, points);
  }
  static double farthest_px(const std::vector<Eigen::Vector2d>& a,
                            const std::vector<Eigen::Vector2d>& b) {
    double out = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, (a[i] - b[i]).norm());
    return out;
  }

  PoseShift pose_std_ = (PoseShift() << 1e-3, 2e-3, 1e-3, 0.1, 0.2, 0.5).finished();
  test_support::DipoleCube cube_;
};

TEST_F(ViewShiftTest, OfThePose) {
  PoseShift expected = PoseShift::Zero();
  std::vector<PriorPull> pulls;
  // Pose k is the k-th independent combination: the covariance's root is unique up to its order.
  for (int k = 0; k < 6; ++k) pulls.push_back({"pose" + std::to_string(k), "pose", 0.0, 1.0});
  const PoseShift found = most_probable_shift(cube_.scene, shot(), pulls);
  for (Eigen::Index k = 0; k < 6; ++k) EXPECT_NEAR(std::abs(found[k]), pose_std_[k], 1e-12);
  EXPECT_EQ(most_probable_shift(cube_.scene, shot(), {}), expected);
}

// The object 0.3 mm to the side and 0.4 % larger.
TEST_F(ViewShiftTest, OfTheObject) {
  const PoseShift found = most_probable_shift(cube_.scene, shot(),
                                              {{"cube.position0", "mesh position", 0.0, 0.3},
                                               {"cube.size", "mesh scale", 0.0, 0.004},
                                               {"other.position0", "mesh position", 0.0, 9.0}});
  const Rigid3d moved = pose() * Rigid3d{Eigen::Quaterniond::Identity(), {0.3, 0.0, 0.0}};
  const CameraIntrinsics& lens = cube_.scene.camera.intrinsics;
  const auto true_px = image(lens, moved, 1.004);
  const double off = farthest_px(image(lens, pose()), true_px);
  EXPECT_LT(farthest_px(image(lens, shifted_pose(pose(), found)), true_px), 0.01 * off);
}

// A principal point 3 px to the right moves the picture as a turn of the camera does.
TEST_F(ViewShiftTest, OfTheLens) {
  LensRoot root = LensRoot::Zero(kLensParameters, 1);
  root(2, 0) = 1.0;
  cube_.scene.camera.lens_root = root;
  const PoseShift found = most_probable_shift(cube_.scene, shot(), {{"lens0", "lens", 0.0, 3.0}});
  const CameraIntrinsics& lens = cube_.scene.camera.intrinsics;
  CameraIntrinsics other = lens;
  other.cx_px += 3.0;
  const auto true_px = image(other, pose());
  EXPECT_NEAR(farthest_px(image(lens, pose()), true_px), 3.0, 1e-9);
  EXPECT_LT(farthest_px(image(lens, shifted_pose(pose(), found)), true_px), 0.1);
}

std::vector<PriorPull> at_side(double mm) { return {{"cube.position0", "mesh position", 0.0, mm}}; }

TEST(ViewShift, IsDeterminedBeyondItsDeviation) {
  const auto pull = [](const char* group, double offset) {
    return PriorPull{"q", group, 1.0, offset, 0.01, 1.0, 0.1};
  };
  EXPECT_FALSE(is_determined_elsewhere({}));
  EXPECT_FALSE(is_determined_elsewhere({pull("mesh position", 0.24), pull("pose", -0.24)}));
  EXPECT_TRUE(is_determined_elsewhere({pull("pose", 0.0), pull("mesh position", -0.26)}));
  // A light that is off moves no view.
  EXPECT_FALSE(is_determined_elsewhere({pull("LED position", 0.9)}));
}

TEST_F(ViewShiftTest, IsVisibleAgainstThePatch) {
  const double patch_mm = shot().seen->patches->patch_size_mm();
  const SeenElsewhere far = seen_elsewhere(cube_.scene, cube_.shots, at_side(0.2));
  ASSERT_EQ(far.shifts.size(), 1U);
  EXPECT_NEAR(far.shifts.at("cube").tail<3>().norm(), 0.2, 1e-3);
  EXPECT_GT(far.motion, kVisibleMotion);
  EXPECT_NEAR(far.motion, 0.2 / patch_mm, 1e-3);  // seen from above
  EXPECT_NEAR(seen_elsewhere(cube_.scene, cube_.shots, at_side(0.02)).motion, 0.1 * far.motion,
              1e-6);
  // The last view came nearer, or it did not.
  EXPECT_EQ(seen_elsewhere(cube_.scene, cube_.shots, at_side(0.2), 1.1 * far.motion).shifts,
            far.shifts);
  const SeenElsewhere half =
      seen_elsewhere(cube_.scene, cube_.shots, at_side(0.2), 0.9 * far.motion);
  EXPECT_LT((half.shifts.at("cube") - 0.5 * far.shifts.at("cube")).norm(), 1e-12);
  EXPECT_EQ(half.motion, far.motion);
  // Seen from there already.
  cube_.shots[0].seen =
      see(cube_.scene, cube_.objects, cube_.lit, "cube", shot().pose, far.shifts.at("cube"));
  EXPECT_LT(seen_elsewhere(cube_.scene, cube_.shots, at_side(0.2)).motion, 1e-9);
  EXPECT_EQ(seen_elsewhere(cube_.scene, cube_.shots, {}).motion, 0.0);
}

// No view goes farther than three deviations of a quantity.
TEST_F(ViewShiftTest, IsBelievable) {
  const auto shift = [&](double pull) {
    return most_probable_shift(cube_.scene, shot(),
                               {{"cube.position0", "mesh position", pull, 0.1 * pull},
                                {"cube.size", "mesh scale", pull, 1e-3 * pull}});
  };
  EXPECT_LT((shift(2.0) - 2.0 * shift(1.0)).norm(), 1e-12);
  EXPECT_LT((shift(9.0) - 3.0 * shift(1.0)).norm(), 1e-12);
  EXPECT_LT((shift(-9.0) + 3.0 * shift(1.0)).norm(), 1e-12);
}

// By its file, and moved by its own pose.
TEST_F(ViewShiftTest, AShotWithItsOwnPoseHasItsOwnView) {
  cube_.shots[0].has_own_pose = true;
  const SeenElsewhere moved = seen_elsewhere(cube_.scene, cube_.shots, at_side(0.2));
  ASSERT_EQ(moved.shifts.size(), cube_.shots.size());
  EXPECT_NEAR(moved.shifts.at(shot().stated->file).tail<3>().norm(), 0.2, 1e-3);
  EXPECT_EQ(most_probable_shift(cube_.scene, shot(), {{"pose3", "pose", 0.0, 1.0}}).norm(), 0.0);
  EXPECT_GT(most_probable_shift(cube_.scene, shot(),
                                {{"pose " + shot().stated->file + "3", "pose", 0.0, 1.0}})
                .norm(),
            0.0);
}

}  // namespace
}  // namespace scattermeter
