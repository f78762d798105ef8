// What the views of a board can tell of a lens.
#pragma once

#include <string>
#include <vector>

#include "calib/lens/camera_bundle.h"

namespace scattermeter::calib {

struct CameraLayout {
  double widest_angle_rad = 0;  // between the normals of two views' boards, as the camera sees them
  // Of 5 x 5 equal fields of the frame: the share that holds a corner of some view.
  double covered_share = 0;
  std::vector<std::string> bare_corners;  // "upper left" ...: of the frame's four corner fields
};

CameraLayout camera_layout(const std::vector<BoardView>& views, const CameraBundle& bundle,
                           int width_px, int height_px);

// What is weak about it, a sentence each with what to do: fewer than eight views; boards parallel
// to within 20 degrees; bare corners of the frame.
std::vector<std::string> layout_warnings(const CameraLayout& layout, std::size_t n_views);

}  // namespace scattermeter::calib
