#include "tests/calib/charuco_scene.h"

#include <cmath>
#include <random>

#include <tbb/parallel_for.h>

#include "tests/calib/pose_scenes.h"

namespace scattermeter::calib {

CameraIntrinsics binned(const CameraIntrinsics& sensor) {
  CameraIntrinsics half = sensor;
  half.width_px /= 2;
  half.height_px /= 2;
  half.fx_px /= 2;
  half.fy_px /= 2;
  half.cx_px = (sensor.cx_px - 0.5) / 2;
  half.cy_px = (sensor.cy_px - 0.5) / 2;
  return half;
}

Rigid3d camera_above_board(const CharucoBoard& board, double distance_mm, double tilt_rad,
                           double azimuth_rad) {
  const Eigen::Vector3d middle(0.5 * board.squares_x * board.square_mm,
                               0.5 * board.squares_y * board.square_mm, 0);
  const Rigid3d camera_from_board = camera_looking_at(middle, distance_mm, tilt_rad, azimuth_rad);
  return camera_from_board * inverse(board.world_from_board);
}

std::vector<float> board_shot(const CameraIntrinsics& camera, const CharucoBoard& board,
                              const Rigid3d& camera_from_world, const BoardLight& light,
                              std::uint64_t seed) {
  constexpr int kSub = 4;
  const CharucoPattern pattern(board);
  const Rigid3d board_from_camera = inverse(camera_from_world * board.world_from_board);
  const Eigen::Vector3d eye = board_from_camera.translation_mm;
  std::vector<float> image(static_cast<size_t>(camera.width_px) *
                           static_cast<size_t>(camera.height_px));
  tbb::parallel_for(0, camera.height_px, [&](int y) {
    std::vector<Eigen::Vector2d> points;
    for (int x = 0; x < camera.width_px; ++x) {
      for (int j = 0; j < kSub; ++j) {
        for (int i = 0; i < kSub; ++i) {
          points.emplace_back(x + (i + 0.5) / kSub - 0.5, y + (j + 0.5) / kSub - 0.5);
        }
      }
    }
    const std::vector<Eigen::Vector2d> rays = undistort(camera, points);
    size_t next = 0;
    for (int x = 0; x < camera.width_px; ++x) {
      double sum = 0;
      for (int k = 0; k < kSub * kSub; ++k) {
        const Eigen::Vector2d& ray = rays[next++];
        const Eigen::Vector3d direction =
            board_from_camera.rotation * Eigen::Vector3d(ray.x(), ray.y(), 1);
        const Eigen::Vector3d hit = eye - eye.z() / direction.z() * direction;
        const double r = pattern.reflectance(hit.x(), hit.y());
        sum += std::isnan(r) ? light.background : light.black + r * (light.white - light.black);
      }
      image[static_cast<size_t>(y) * static_cast<size_t>(camera.width_px) +
            static_cast<size_t>(x)] = static_cast<float>(sum / (kSub * kSub));
    }
  });
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, light.noise);
  for (float& v : image) v += static_cast<float>(normal(random));
  return image;
}

}  // namespace scattermeter::calib
