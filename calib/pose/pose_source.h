// The source of the camera pose in the shots.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/board/charuco_board.h"
#include "calib/pose/pose.h"

namespace scattermeter::calib {

struct PoseSource {
  std::vector<PointPair> points;  // either points or charuco
  std::optional<CharucoBoard> charuco;
  // With charuco: the single shot of the board, taken from the same camera position as all others;
  // "": the board is in each shot.
  std::string board_shot;
  PoseOptions options;
  bool refine_by_silhouette = false;
  double edge_std_px = 0.1;  // see SilhouetteOptions::line_std_px
  bool per_shot = false;     // the camera may move between shots; always true with a board in each
  int line = 0;              // in the scene's source
};

}  // namespace scattermeter::calib
