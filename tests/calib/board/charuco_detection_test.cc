#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "calib/board/charuco_board.h"
#include "tests/fixtures/calib/charuco_scene.h"
#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

CharucoBoard board_in_world() {
  CharucoBoard board;
  board.squares_x = 6;
  board.squares_y = 5;
  board.square_mm = 8;
  board.marker_mm = 5.8;
  board.world_from_board.rotation = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized());
  board.world_from_board.translation_mm = {100, -40, 25};
  return board;
}

// A quarter of the typical sensor, so that rendering does not dominate the tests.
CameraIntrinsics sensor() { return {1936, 1296, 4918, 4918, 967.5, 647.5, {}}; }
CameraIntrinsics bent_sensor() {
  return {1936, 1296, 1500, 1495, 960, 655, {-0.28, 0.1, 0.0008, -0.0004}};
}

std::vector<PointPair> find(const CharucoBoard& board, const std::vector<float>& image,
                            const CameraIntrinsics& half) {
  return find_charuco_corners(board, image, half.width_px, half.height_px, 2, 0.5);
}

// Every corner in the frame is found where project() says, and the pose comes back within its
// covariance. That the board is drawn, seen and located in one frame shows in the world positions:
// any turn or reflection of it would be a wrong pose.
TEST(FindCharucoCorners, RecoversThePose) {
  const CharucoBoard board = board_in_world();
  struct Case {
    CameraIntrinsics camera;
    double distance_mm;
    double tilt_rad;
    double azimuth_rad;
  };
  for (const Case& c : {Case{sensor(), 200, 0.2, 0.5}, Case{sensor(), 190, 0.8, 2.5},
                        Case{bent_sensor(), 70, 0.5, 4.0}}) {
    const Rigid3d pose = camera_above_board(board, c.distance_mm, c.tilt_rad, c.azimuth_rad);
    const CameraIntrinsics half = binned(c.camera);
    const std::vector<PointPair> pairs = find(board, board_shot(half, board, pose, {}, 7), half);
    EXPECT_EQ(pairs.size(), 20U);
    std::vector<Eigen::Vector3d> world;
    world.reserve(pairs.size());
    for (const PointPair& pair : pairs) world.push_back(pair.world_mm);
    const std::vector<Eigen::Vector2d> expected = project(c.camera, pose, world);
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (size_t i = 0; i < pairs.size(); ++i) {
      const Eigen::Vector2d error = pairs[i].image_px - expected[i];
      EXPECT_LT(error.norm(), 0.7);  // in the sensor's pixels, of which each sample spans two
      mean += error / static_cast<double>(pairs.size());
    }
    // A shift of half a sample would be one pixel here.
    EXPECT_LT(mean.norm(), 0.15);

    const PoseResult result = estimate_pose(c.camera, pairs);
    ASSERT_EQ(result.status, PoseStatus::kOk) << result.message;
    const Eigen::Matrix<double, 6, 1> error = pose_error(result.camera_from_world, pose);
    // chi-squared of 6 degrees of freedom: 27.9 is passed once in 10^4.
    EXPECT_LT(error.dot(result.covariance.ldlt().solve(error)), 27.9);
  }
}

TEST(FindCharucoCorners, AnyScaleOfRadianceAndHotSamples) {
  const CharucoBoard board = board_in_world();
  const CameraIntrinsics half = binned(sensor());
  const Rigid3d pose = camera_above_board(board, 200, 0.4, 1);
  // A dark board, at 1 % of the background, in arbitrary units with an offset.
  BoardLight light;
  light.background = 60;
  light.noise = 0.002;
  std::vector<float> image = board_shot(half, board, pose, light, 3);
  for (float& v : image) v = -50 + 1e4F * v;
  for (size_t i = 1000; i < image.size(); i += 50021) image[i] = 1e9F;
  image[12345] = std::nanf("");
  image[54321] = -std::numeric_limits<float>::infinity();
  EXPECT_GE(find(board, image, half).size(), 18U);
}

TEST(FindCharucoCorners, SameDigitsForAnyNumberOfThreads) {
  const CharucoBoard board = board_in_world();
  const CameraIntrinsics half = binned(sensor());
  const std::vector<float> image =
      board_shot(half, board, camera_above_board(board, 200, 0.4, 1), {}, 9);
  cv::setNumThreads(1);
  const std::vector<PointPair> one = find(board, image, half);
  cv::setNumThreads(4);
  const std::vector<PointPair> four = find(board, image, half);
  cv::setNumThreads(-1);  // the default again
  ASSERT_EQ(one.size(), four.size());
  ASSERT_FALSE(one.empty());
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].world_mm, four[i].world_mm);
    EXPECT_EQ(one[i].image_px, four[i].image_px);
  }
}

TEST(FindCharucoCorners, LargerThanTheFrame) {
  const CharucoBoard board = board_in_world();
  const CameraIntrinsics half = binned(sensor());
  const Rigid3d pose = camera_above_board(board, 90, 0.3, 1);
  const std::vector<PointPair> pairs = find(board, board_shot(half, board, pose, {}, 5), half);
  EXPECT_GE(pairs.size(), 4U);
  EXPECT_LT(pairs.size(), 20U);
  EXPECT_EQ(estimate_pose(sensor(), pairs).status, PoseStatus::kOk);
}

TEST(FindCharucoCorners, PartlyHidden) {
  const CharucoBoard board = board_in_world();
  const CameraIntrinsics half = binned(sensor());
  const Rigid3d pose = camera_above_board(board, 200, 0.3, 1);
  std::vector<float> image = board_shot(half, board, pose, {}, 5);
  // Something dark lies over the left half of the frame.
  for (size_t i = 0; i < image.size(); ++i) {
    if (i % static_cast<size_t>(half.width_px) < static_cast<size_t>(half.width_px) / 2) {
      image[i] = 0.1F;
    }
  }
  const std::vector<PointPair> pairs = find(board, image, half);
  EXPECT_GE(pairs.size(), 4U);
  EXPECT_LE(pairs.size(), 12U);
  for (const PointPair& pair : pairs) EXPECT_GT(pair.image_px.x(), 950);
}

TEST(FindCharucoCorners, EmptyWhereThereIsNone) {
  const CharucoBoard board = board_in_world();
  const CameraIntrinsics half = binned(sensor());
  const size_t n = static_cast<size_t>(half.width_px) * static_cast<size_t>(half.height_px);
  EXPECT_TRUE(find(board, std::vector<float>(n, 0.5F), half).empty());
  EXPECT_TRUE(find(board, std::vector<float>(n, std::nanf("")), half).empty());
  std::mt19937_64 random(1);
  std::normal_distribution<float> normal(0.5F, 0.05F);
  std::vector<float> noise(n);
  for (float& v : noise) v = normal(random);
  EXPECT_TRUE(find(board, noise, half).empty());
  EXPECT_TRUE(find_charuco_corners(board, {0.1F, 0.2F, 0.3F, 0.4F}, 2, 2, 1, 0).empty());
  EXPECT_TRUE(find_charuco_corners(board, {0.1F, 0.2F, 0.3F, 0.4F}, 4, 1, 1, 0).empty());
}

TEST(FindCharucoCorners, BrokenPreconditionsThrow) {
  const CharucoBoard board = board_in_world();
  EXPECT_THROW(find_charuco_corners(board, {0, 0, 0}, 2, 2, 1, 0), std::invalid_argument);
  EXPECT_THROW(find_charuco_corners(board, {}, 0, 0, 1, 0), std::invalid_argument);
  EXPECT_THROW(find_charuco_corners(board, {0}, 1, 1, 0, 0), std::invalid_argument);
  EXPECT_THROW(find_charuco_corners(board, {0}, 1, 1, 1, std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
