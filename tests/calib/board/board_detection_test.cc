#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "calib/board/calibration_board.h"
#include "core/camera/lens.h"
#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

const CalibrationBoard kBoard{BoardKind::kChessboard, 8, 6, 30};

// The mean over 6 x 6 points of a square of 1.8 px about each pixel (its own area and a blur of
// about half a pixel), and noise.
std::vector<float> picture_of(const CameraIntrinsics& k, const Rigid3d& pose, double noise) {
  constexpr int kSub = 6;
  const BoardPattern pattern(kBoard);
  const Lens lens(k);
  const Rigid3d board_from_camera = inverse(pose);
  const Eigen::Vector3d eye = board_from_camera.translation_mm;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0, noise);
  std::vector<float> out;
  Eigen::Vector2d ray(0, 0);
  for (int y = 0; y < k.height_px; ++y) {
    for (int x = 0; x < k.width_px; ++x) {
      double sum = 0;
      for (int i = 0; i < kSub * kSub; ++i) {
        const double dx = 1.8 * ((i % kSub + 0.5) / kSub - 0.5);
        const double dy = 1.8 * ((static_cast<int>(i / kSub) + 0.5) / kSub - 0.5);
        ray = lens.unproject({x + dx, y + dy}, ray);
        const Eigen::Vector3d d = board_from_camera.rotation * Eigen::Vector3d(ray.x(), ray.y(), 1);
        const Eigen::Vector3d hit = eye - eye.z() / d.z() * d;
        const double r = pattern.reflectance(hit.x(), hit.y());
        sum += std::isnan(r) ? 0.9 : 0.05 + 0.85 * r;
      }
      out.push_back(static_cast<float>(sum / (kSub * kSub) + normal(random)));
    }
  }
  return out;
}

TEST(BoardDetection, CornersToATenthOfAPixel) {
  const CameraIntrinsics k{280, 210, 320, 320, 142, 103, {-0.1, 0, 0, 0}};
  for (const double azimuth : {0.4, 4.0}) {
    const Rigid3d pose = camera_looking_at({120, 90, 0}, 420, 0.5, azimuth);
    const std::vector<float> picture = picture_of(k, pose, 0.005);
    const auto pairs = find_board_corners(kBoard, picture, 280, 210, 1, 0);
    ASSERT_EQ(pairs.size(), 35U);
    // It may have been numbered from the other end: the pose tells.
    double sum = 0;
    for (const PointPair& pair : pairs) {
      double nearest = 1e9;
      for (const bool turned : {false, true}) {
        const Eigen::Vector3d x =
            turned ? Eigen::Vector3d(240 - pair.world_mm.x(), 180 - pair.world_mm.y(), 0)
                   : pair.world_mm;
        nearest = std::min(nearest, (project(k, pose, {x})[0] - pair.image_px).norm());
      }
      sum += nearest * nearest;
    }
    EXPECT_LT(std::sqrt(sum / 35), 0.1);  // 0.06 as a rule
    // As a picture of cells of 2 x 2 samples.
    const auto scaled = find_board_corners(kBoard, picture, 280, 210, 2, 0.5);
    EXPECT_NEAR(scaled[3].image_px.x(), 2 * pairs[3].image_px.x() + 0.5, 1e-9);
  }
}

TEST(BoardDetection, NothingWhereThereIsNoBoard) {
  EXPECT_TRUE(find_board_corners(kBoard, std::vector<float>(120000, 0.5F), 400, 300, 1, 0).empty());
  std::mt19937_64 random(2);
  std::uniform_real_distribution<float> even(0, 1);
  std::vector<float> noise(120000);
  for (float& v : noise) v = even(random);
  EXPECT_TRUE(find_board_corners(kBoard, noise, 400, 300, 1, 0).empty());
  // Another number of squares.
  const CameraIntrinsics k{280, 210, 320, 320, 142, 103, {}};
  const Rigid3d pose = camera_looking_at({120, 90, 0}, 420, 0.5, 1);
  const CalibrationBoard larger{BoardKind::kChessboard, 10, 7, 30};
  EXPECT_TRUE(find_board_corners(larger, picture_of(k, pose, 0.005), 280, 210, 1, 0).empty());
}

TEST(BoardDetection, PreconditionsAreNamed) {
  EXPECT_THROW(find_board_corners(kBoard, {1, 2}, 1, 1, 1, 0), std::invalid_argument);
  EXPECT_THROW(find_board_corners(kBoard, {1}, 1, 1, 0, 0), std::invalid_argument);
  EXPECT_THROW(find_board_corners({BoardKind::kChessboard, 2, 2, 30}, {1}, 1, 1, 1, 0),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
