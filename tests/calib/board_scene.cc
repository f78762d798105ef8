#include "tests/calib/board_scene.h"

#include <numbers>
#include <random>

#include "calib/lens.h"
#include "core/random_stream.h"
#include "tests/calib/pose_scenes.h"

namespace scattermeter::calib {

CameraIntrinsics board_lens() { return {640, 480, 700, 700, 325, 236, {-0.2, 0.1, 0, 0, 0}}; }

BoardScene board_scene(const CameraIntrinsics& k, int count, std::uint64_t seed, double tilt_rad) {
  RandomStream random(seed, 1);
  const Lens lens(k);
  BoardScene scene;
  for (int i = 0; i < count; ++i) {
    const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
    const double tilt = tilt_rad >= 0 ? tilt_rad : between(0.26, 0.7);
    const double azimuth = 2 * std::numbers::pi * (i + random.uniform()) / count;
    const Eigen::Vector3d target(150 + between(-60, 60), 105 + between(-50, 50), 0);
    const Rigid3d pose = camera_looking_at(target, between(420, 560), tilt, azimuth);
    BoardView view{"view" + std::to_string(i), {}};
    for (int row = 1; row <= 6; ++row) {
      for (int column = 1; column <= 9; ++column) {
        const Eigen::Vector3d x(30 * column, 30 * row, 0);
        const Eigen::Vector2d p = lens.project(pose * x);
        if (p.x() > 0 && p.y() > 0 && p.x() < k.width_px - 1 && p.y() < k.height_px - 1) {
          view.corners.push_back({x, p});
        }
      }
    }
    scene.views.push_back(view);
    scene.camera_from_board.push_back(pose);
  }
  return scene;
}

std::vector<BoardView> with_noise(std::vector<BoardView> views, double noise_px,
                                  std::uint64_t seed) {
  std::mt19937_64 random(RandomStream(seed, 2).bits());
  std::normal_distribution<double> normal(0, noise_px);
  for (BoardView& view : views) {
    for (PointPair& c : view.corners) c.image_px += Eigen::Vector2d(normal(random), normal(random));
  }
  return views;
}

CameraBundle true_bundle(const CameraIntrinsics& lens, const BoardScene& scene) {
  CameraBundle bundle;
  bundle.lens = lens_parameters(lens);
  bundle.camera_from_board = scene.camera_from_board;
  return bundle;
}

}  // namespace scattermeter::calib
