#include "apps/rig/rig_pose_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

const std::string kPosePoints =
    "points:\n"
    "  - {world_mm: [-26, -14, 0], image_px: [100.5, 200.25]}\n"
    "  - {world_mm: [26, -14, 1], image_px: [300, 210]}\n";
const std::string kPoseBoard =
    "charuco: {squares: [10, 8], square_mm: 6, marker_mm: 4.5, dictionary: DICT_4X4_100, "
    "origin_mm: "
    "[-30, -22, 0], x_axis: [0, 2, 0], y_axis: [-1, 0, 0]}\n";

std::string pose_refused(const std::string& text) {
  return refusal_of([&] { read_pose(yaml_text(text)); });
}

TEST(RigPoseReader, Points) {
  const calib::PoseSource pose =
      read_pose(yaml_text(kPosePoints + "inlier_px: 3\npoint_std_px: 0.05\n"));
  ASSERT_EQ(pose.points.size(), 2U);
  EXPECT_EQ(pose.points[1].world_mm, Eigen::Vector3d(26, -14, 1));
  EXPECT_EQ(pose.points[0].image_px, Eigen::Vector2d(100.5, 200.25));
  EXPECT_FALSE(pose.charuco || pose.refine_by_silhouette || pose.per_shot);
  EXPECT_EQ(pose.options.inlier_px, 3.0);
  EXPECT_EQ(pose.options.point_std_px, 0.05);
}

TEST(RigPoseReader, Board) {
  const calib::PoseSource pose = read_pose(yaml_text(kPoseBoard));
  ASSERT_TRUE(pose.charuco.has_value());
  EXPECT_EQ(pose.charuco->squares_x, 10);
  EXPECT_EQ(pose.charuco->marker_mm, 4.5);
  EXPECT_EQ(pose.charuco->dictionary, "DICT_4X4_100");
  // The board's x runs along the world's y, its y along -x, its origin in the corner.
  const Eigen::Vector3d p = pose.charuco->world_from_board * Eigen::Vector3d(3, 5, 0);
  EXPECT_NEAR((p - Eigen::Vector3d(-35, -19, 0)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(pose.per_shot);  // it is in every shot
  EXPECT_EQ(pose.options.point_std_px, 0.15);
  const calib::PoseSource own = read_pose(yaml_text(kPoseBoard + "shot: board.dng\n"));
  EXPECT_EQ(own.board_shot, "board.dng");
  EXPECT_FALSE(own.per_shot);
}

TEST(RigPoseReader, Silhouette) {
  const calib::PoseSource pose =
      read_pose(yaml_text(kPosePoints + "refine: silhouette\nedge_std_px: 0.2\nper_shot: true\n"));
  EXPECT_TRUE(pose.refine_by_silhouette);
  EXPECT_TRUE(pose.per_shot);
  EXPECT_EQ(pose.edge_std_px, 0.2);
}

TEST(RigPoseReader, NamesWhatIsWrong) {
  EXPECT_THAT(pose_refused(kPosePoints + kPoseBoard), HasSubstr("either points or charuco"));
  EXPECT_THAT(pose_refused("inlier_px: 3\n"), HasSubstr("either points or charuco"));
  EXPECT_THAT(pose_refused(kPosePoints + "edge_std_px: 0.2\n"),
              HasSubstr("edge_std_px: is allowed only with refine: silhouette"));
  EXPECT_THAT(pose_refused(kPosePoints + "refine: edges\n"), HasSubstr("expected silhouette"));
  EXPECT_THAT(pose_refused(kPosePoints + "shot: board.dng\n"), HasSubstr("needs charuco"));
  EXPECT_THAT(pose_refused(kPosePoints + "per_shot: true\n"), HasSubstr("refine: silhouette"));
  EXPECT_THAT(pose_refused(kPosePoints + "per_shot: maybe\n"), HasSubstr("true or false"));
  EXPECT_THAT(pose_refused(kPoseBoard + "per_shot: false\n"), HasSubstr("its own pose"));
  std::string slanted = kPoseBoard;
  slanted.replace(slanted.find("[-1, 0, 0]"), 10, "[-1, 1, 0]");
  EXPECT_THAT(pose_refused(slanted), HasSubstr("x_axis and y_axis are not at right angles"));
  std::string large = kPoseBoard;
  large.replace(large.find("4.5"), 3, "6.5");
  EXPECT_THAT(pose_refused(large), HasSubstr("charuco"));
}

}  // namespace
}  // namespace scattermeter::apps
