#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

PoseResult made_pose(double rms_px, double worst_px, const std::vector<bool>& inlier) {
  PoseResult pose;
  pose.status = PoseStatus::kOk;
  pose.rms_px = rms_px;
  pose.worst_px = worst_px;
  pose.inlier = inlier;
  return pose;
}

TEST(CheckPose, OfTheRigsPoints) {
  MadeCheckedRig made(2);
  made.checked.shared_pose = made_pose(0.4, 0.9, {true, true, true, false, true, true, true, true});
  std::vector<CheckItem> items = check_pose(made.checked);
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].what, "pose");
  EXPECT_TRUE(items[0].passed);
  EXPECT_EQ(items[0].worst, 0.4);
  EXPECT_EQ(items[0].limit, 1.0);
  EXPECT_EQ(items[0].where, "pose.points, 8 points; worst point 0.9 px");
  EXPECT_EQ(items[1].what, "pose outliers");
  EXPECT_EQ(items[1].worst, 12.5);
  EXPECT_TRUE(items[1].passed);
  EXPECT_EQ(items[1].where, "pose.points, 8 points; left out: points[3]");
  made.checked.shared_pose = made_pose(1.1, 3.0, {true, false, false, true});
  items = check_pose(made.checked);
  EXPECT_FALSE(items[0].passed);
  EXPECT_FALSE(items[1].passed);  // half of them
}

// With a board in each shot, each has a pose of its own.
TEST(CheckPose, OfEachShot) {
  MadeCheckedRig made(2);
  made.checked.shots[0].pose = made_pose(0.3, 0.5, {true, true});
  made.checked.shots[1].pose = made_pose(0.4, 0.7, {true, true});
  const std::vector<CheckItem> items = check_pose(made.checked);
  ASSERT_EQ(items[0].details.size(), 2U);
  EXPECT_EQ(items[0].details[1].shot_idx, 1U);
  EXPECT_NEAR(items[0].rms, std::sqrt(0.125), 1e-12);
  EXPECT_EQ(items[0].where, "b.dng, 2 points; worst point 0.7 px");
}

TEST(CheckPose, OfTheLens) {
  MadeCheckedRig made(1);
  made.rig.intrinsics_path = "camera.yaml";
  made.checked.shared_pose = made_pose(0.1, 0.1, {true});
  calib::CameraCalibrationFile& lens = made.checked.lens.emplace();
  EXPECT_EQ(check_pose(made.checked).size(), 2U);  // a file of OpenCV's own has no residuals
  lens.rms_px = 0.6;
  lens.worst_px = 1.7;
  lens.residuals.resize(1);
  const std::vector<CheckItem> items = check_pose(made.checked);
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items[1].what, "lens");
  EXPECT_FALSE(items[1].passed);
  EXPECT_EQ(items[1].rms, 0.6);
  EXPECT_EQ(items[1].worst, 1.7);
  EXPECT_EQ(items[1].where, "camera.yaml");
}

}  // namespace
}  // namespace scattermeter::apps
