// Views of a board with known lens and poses.
#pragma once

#include <cstdint>
#include <vector>

#include "calib/camera_bundle.h"

namespace scattermeter::calib {

// 640 x 480, f = 700 px, k1 and k2 of a mild barrel, 6 px at the frame's corner.
CameraIntrinsics board_lens();

struct BoardScene {
  std::vector<BoardView> views;  // without noise: corners in the frame only
  std::vector<Rigid3d> camera_from_board;
};

// 9 x 6 corners, 30 mm apart, seen from `count` places about 500 mm away, tilted by 15 to 40
// degrees to all sides (or by `tilt_rad`, the same for all), drawn with `seed`.
BoardScene board_scene(const CameraIntrinsics& lens, int count, std::uint64_t seed,
                       double tilt_rad = -1);

// With Gaussian noise of noise_px per coordinate.
std::vector<BoardView> with_noise(std::vector<BoardView> views, double noise_px,
                                  std::uint64_t seed);

// Lens and poses of a scene as a bundle.
CameraBundle true_bundle(const CameraIntrinsics& lens, const BoardScene& scene);

}  // namespace scattermeter::calib
