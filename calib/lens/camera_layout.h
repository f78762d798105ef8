// Layout of the views of a board: how well it can determine a lens.
#pragma once

#include <string>
#include <vector>

#include "calib/lens/camera_bundle.h"

namespace scattermeter::calib {

struct CameraLayout {
  double widest_angle_rad = 0;  // between the board normals of two views, in the camera frame
  // The share of 5 x 5 equal fields of the frame that contain a corner of some view.
  double covered_share = 0;
  std::vector<std::string> bare_corners;  // "upper left" ...: of the frame's four corner fields
};

CameraLayout camera_layout(const std::vector<BoardView>& views, const CameraBundle& bundle,
                           int width_px, int height_px);

// The weaknesses of a layout, each as a sentence with advice: fewer than eight views, boards
// parallel to within 20 degrees, corners of the frame without any board corner.
std::vector<std::string> layout_warnings(const CameraLayout& layout, std::size_t n_views);

}  // namespace scattermeter::calib
