// Shots of a board from which a lens is calibrated.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/board/calibration_board.h"

namespace scattermeter::calib {

// Position and orientation of the camera. The board lies in the plane z = 0 of the world, with its
// origin at that of the world.
struct BoardViewpoint {
  Eigen::Vector3d position_mm;
  Eigen::Vector3d look_at_mm;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

struct BoardShot {
  std::string file;
  std::optional<BoardViewpoint> viewpoint;  // for simulation only
  int line = 0;                             // in BoardShots::path
};

struct BoardShots {
  CalibrationBoard board;
  double board_std_mm = 0;  // standard deviation of each coordinate of a printed corner
  std::vector<BoardShot> shots;
  std::string path;  // file that lists the shots, for messages
  int line = 0;

  // "rig.yaml:12" for messages.
  std::string at(int line_number) const { return path + ":" + std::to_string(line_number); }
};

}  // namespace scattermeter::calib
