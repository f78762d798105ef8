#include "apps/rig/rig_pose_reader.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

const char* const kPoints = "points: [{world_mm: [1, 2, 3], image_px: [4, 5]}]";
const char* const kBoard = "charuco: {squares: [5, 7], square_mm: 10, marker_mm: 7}";

calib::PoseSource pose_of(const std::string& text) {
  return read_pose(YamlField(YAML::Load(text), "rig.yaml", "pose"));
}

std::string pose_error(const std::string& text) {
  try {
    pose_of(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(RigPoseReader, PointsShareOnePose) {
  const calib::PoseSource pose = pose_of(kPoints);
  ASSERT_EQ(pose.points.size(), 1U);
  EXPECT_EQ(pose.points[0].world_mm, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(pose.points[0].image_px, Eigen::Vector2d(4, 5));
  EXPECT_EQ(pose.options.point_std_px, 0.3);
  EXPECT_FALSE(pose.charuco);
  EXPECT_FALSE(pose.per_shot);
  EXPECT_FALSE(pose.refine_by_silhouette);
}

TEST(RigPoseReader, ABoardIsInEveryShotUnlessOneIsNamed) {
  const calib::PoseSource each = pose_of(kBoard);
  ASSERT_TRUE(each.charuco);
  EXPECT_EQ(each.charuco->squares_x, 5);
  EXPECT_EQ(each.charuco->squares_y, 7);
  EXPECT_EQ(each.options.point_std_px, 0.15);
  EXPECT_TRUE(each.per_shot);
  const calib::PoseSource one = pose_of(std::string(kBoard) + "\nshot: board.dng\npoint_std_px: 1");
  EXPECT_EQ(one.board_shot, "board.dng");
  EXPECT_EQ(one.options.point_std_px, 1.0);
  EXPECT_FALSE(one.per_shot);
}

// The axes of the board are right-handed, with z out of the print.
TEST(RigPoseReader, TheBoardHasItsOwnAxes) {
  const calib::PoseSource pose = pose_of(
      "charuco: {squares: [5, 7], square_mm: 10, marker_mm: 7, origin_mm: [1, 2, 3], "
      "x_axis: [0, 2, 0], y_axis: [0, 0, 5]}");
  const Rigid3d& board = pose.charuco->world_from_board;
  EXPECT_LT((board * Eigen::Vector3d(10, 0, 0) - Eigen::Vector3d(1, 12, 3)).norm(), 1e-12);
  EXPECT_LT((board * Eigen::Vector3d(0, 10, 0) - Eigen::Vector3d(1, 2, 13)).norm(), 1e-12);
  EXPECT_LT((board * Eigen::Vector3d(0, 0, 10) - Eigen::Vector3d(11, 2, 3)).norm(), 1e-12);
  EXPECT_THAT(pose_error("charuco: {squares: [5, 7], square_mm: 10, marker_mm: 7, "
                         "y_axis: [1, 1, 0]}"),
              HasSubstr("pose.charuco.y_axis: expected a direction at right angles to x_axis"));
}

TEST(RigPoseReader, NamesWhatContradicts) {
  const std::string points = kPoints;
  const std::string board = kBoard;
  EXPECT_THAT(pose_error(points + "\n" + board), HasSubstr("expected either points or charuco"));
  EXPECT_THAT(pose_error("refine: silhouette"), HasSubstr("expected either points or charuco"));
  EXPECT_THAT(pose_error(points + "\nrefine: edges"),
              HasSubstr("pose.refine: expected silhouette"));
  EXPECT_THAT(pose_error(points + "\nedge_std_px: 0.2"), HasSubstr("only with refine: silhouette"));
  EXPECT_THAT(pose_error(points + "\nshot: board.dng"), HasSubstr("needs charuco"));
  EXPECT_THAT(pose_error(points + "\nper_shot: true"), HasSubstr("needs refine: silhouette"));
  EXPECT_THAT(pose_error(board + "\nper_shot: false"), HasSubstr("each shot has its own pose"));
  EXPECT_EQ(pose_error(points + "\nrefine: silhouette\nedge_std_px: 0.2\nper_shot: true"), "");
}

}  // namespace
}  // namespace scattermeter::apps
