#include "calib/pose/shot_pose.h"

#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/calib/charuco_scene.h"
#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

// A scene in which only the camera and the names for messages are set.
Scene scene_of(const CameraIntrinsics& intrinsics) {
  Scene scene;
  scene.source = "rig.yaml";
  scene.camera.intrinsics = intrinsics;
  return scene;
}

CameraIntrinsics board_camera() {
  CameraIntrinsics camera;
  camera.width_px = 1200;
  camera.height_px = 900;
  camera.fx_px = camera.fy_px = 2000;
  camera.cx_px = 599.5;
  camera.cy_px = 449.5;
  return camera;
}

PoseSource board_source() {
  PoseSource source;
  source.charuco.emplace();
  source.charuco->squares_x = 8;
  source.charuco->squares_y = 6;
  source.charuco->square_mm = 10;
  source.charuco->marker_mm = 7.5;
  source.line = 12;
  return source;
}

// A raw frame whose 2 x 2 cells have the values of an image of half its size.
capture::RawFrame frame_of_cells(const std::vector<float>& cells, int width_px, int height_px) {
  capture::RawFrame frame;
  frame.width_px = width_px;
  frame.height_px = height_px;
  frame.white_counts = 65535;
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) {
      const auto cell = static_cast<std::size_t>(y / 2 * (width_px / 2) + x / 2);
      frame.samples.push_back(static_cast<std::uint16_t>(10'000 + 40'000 * cells[cell]));
    }
  }
  return frame;
}

capture::RawFrame board_frame(const PoseSource& source, const Rigid3d& pose) {
  const CameraIntrinsics camera = board_camera();
  return frame_of_cells(board_shot(binned(camera), *source.charuco, pose, {}, 3), camera.width_px,
                        camera.height_px);
}

template <typename Call>
std::string refused_pose(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ShotPose, ExactPointsGiveTheExactPose) {
  std::mt19937_64 random(1);
  const Rigid3d truth = camera_looking_at({0, 0, 0}, 180, 0.7, 2);
  PoseSource source;
  source.points = shot(long_lens(), truth, cube_points(10), 0, &random);
  const PoseResult pose = pose_from_points(scene_of(long_lens()), source);
  EXPECT_LT(pose_error(pose.camera_from_world, truth).norm(), 1e-8);
}

TEST(ShotPose, TooFewPointsAreRefusedWithTheLine) {
  std::mt19937_64 random(1);
  PoseSource source;
  source.line = 12;
  source.points =
      shot(long_lens(), camera_looking_at({0, 0, 0}, 180, 0.7, 2), square_points(10), 0, &random);
  source.points.pop_back();
  EXPECT_THAT(refused_pose([&] { pose_from_points(scene_of(long_lens()), source); }),
              HasSubstr("rig.yaml:12: pose.points: a pose needs at least four point pairs"));
}

TEST(ShotPose, BoardGivesThePoseWithinItsCovariance) {
  const PoseSource source = board_source();
  const Rigid3d truth = camera_above_board(*source.charuco, 180, 0.4, 1);
  const PoseResult pose =
      pose_from_board(scene_of(board_camera()), source, board_frame(source, truth), "board.dng");
  const Eigen::Matrix<double, 6, 1> error = pose_error(pose.camera_from_world, truth);
  EXPECT_LT(error.dot(pose.covariance.ldlt().solve(error)), 6.0);  // the mean of chi-square
}

TEST(ShotPose, CornersOfABoardShotReplaceTheBoard) {
  const PoseSource board = board_source();
  const capture::RawFrame frame =
      board_frame(board, camera_above_board(*board.charuco, 180, 0.4, 1));
  PoseSource points = board;
  take_points_from_board_shot(frame, "board.dng", points);
  EXPECT_FALSE(points.charuco.has_value());
  EXPECT_EQ(points.points.size(), 7U * 5U);
  const Scene scene = scene_of(board_camera());
  const PoseResult a = pose_from_points(scene, points);
  const PoseResult b = pose_from_board(scene, board, frame, "board.dng");
  EXPECT_EQ(a.camera_from_world.translation_mm, b.camera_from_world.translation_mm);
}

TEST(ShotPose, FrameWithoutTheBoardIsRefusedByName) {
  const std::vector<float> grey(std::size_t{600} * 450, 0.5F);
  const capture::RawFrame frame = frame_of_cells(grey, 1200, 900);
  EXPECT_EQ(refused_pose([&] {
              pose_from_board(scene_of(board_camera()), board_source(), frame, "grey.dng");
            }),
            "grey.dng: pose.charuco: the board is not seen in this shot: see that it is whole and "
            "sharp, and that dictionary and squares are its own");
}

TEST(ShotPose, MissingBoardShotIsNamedWithTheLine) {
  PoseSource source = board_source();
  source.board_shot = "board.dng";
  EXPECT_EQ(refused_pose([&] {
              take_points_from_board_shot(scene_of(board_camera()), {}, "/nowhere", source);
            }),
            "rig.yaml:12: pose.shot: is not in the folder /nowhere: board.dng");
}

TEST(ShotPose, SourceWithoutABoardShotIsUnchanged) {
  PoseSource source = board_source();
  take_points_from_board_shot(scene_of(board_camera()), {}, "/nowhere", source);
  EXPECT_TRUE(source.charuco.has_value());
  EXPECT_TRUE(source.points.empty());
}

TEST(ShotPose, SilhouettesNeedFrames) {
  capture::ShotSource shots;
  shots.open = capture::SampleSource([](std::size_t, const SampleMap&) { return CfaSamples{}; });
  EXPECT_THROW(pose_from_silhouettes(scene_of(board_camera()), {}, {}, {}, shots),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
