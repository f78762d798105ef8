// A synthetic shot of a ChArUco board.
#pragma once

#include <cstdint>
#include <vector>

#include "calib/camera_model.h"
#include "calib/charuco_board.h"

namespace scattermeter::calib {

// The camera that has the pixels of 2 x 2 binning: its pixel u is the sensor's 2 u + 0.5.
CameraIntrinsics binned(const CameraIntrinsics& sensor);

// Pose of a camera that sees the board's middle in the middle, from the printed side.
Rigid3d camera_above_board(const CharucoBoard& board, double distance_mm, double tilt_rad,
                           double azimuth_rad);

struct BoardLight {
  double white = 0.8;       // radiance of the paper
  double black = 0.04;      // of the ink
  double background = 0.2;  // of what is around the board
  double noise = 0.005;     // standard deviation, Gaussian
};

// Radiance per pixel, the mean over 4 x 4 points of each.
std::vector<float> board_shot(const CameraIntrinsics& camera, const CharucoBoard& board,
                              const Rigid3d& camera_from_world, const BoardLight& light,
                              std::uint64_t seed);

}  // namespace scattermeter::calib
