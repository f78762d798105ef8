// Where the camera's pose in the shots comes from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/board/charuco_board.h"
#include "calib/pose/pose.h"

namespace scattermeter::calib {

struct PoseSource {
  std::vector<PointPair> points;  // one or the other
  std::optional<CharucoBoard> charuco;
  // With charuco: the one shot of the board, taken from where all others are; "": it is in each.
  std::string board_shot;
  PoseOptions options;
  bool refine_by_silhouette = false;
  double edge_std_px = 0.1;  // see SilhouetteOptions::line_std_px
  bool per_shot = false;     // the camera may have moved between the shots; always, with a board
  int line = 0;              // in the scene's source
};

}  // namespace scattermeter::calib
