// Which views of a board, and which of their corners, a calibration can use.
#pragma once

#include <string>
#include <vector>

#include "calib/lens/camera_bundle.h"

namespace scattermeter::calib {

struct LeftOutView {
  std::string name;
  std::string reason;  // a sentence for the user
};

struct LeftOutCorner {
  std::string view;
  Eigen::Vector2d image_px;
  double distance_px = 0;  // from where the others put it
};

struct ViewSelection {
  std::vector<BoardView> views;  // with the corners that are used
  CameraBundle bundle;           // of these
  std::vector<LeftOutView> left_out;
  std::vector<LeftOutCorner> corners_left_out;
  // "" or why the views cannot be used together: their corners agree with no camera.
  std::string fault;
};

// In this order, a view is left out when
// - it has fewer than eight corners, or they lie on a line;
// - it has the corners of another view to 1e-3 px: the same shot twice counts once;
// - no perspective brings 7 in 10 of its corners within 2 % of the frame's width: they are not
//   those of this board;
// - in the joint fit with Cauchy's loss its median residual is more than four times the median of
//   the views' medians (the worst first, and fitted anew); one that fits later on comes back;
// - more than a quarter of its corners are left out.
// A corner is left out when its residual is beyond six standard deviations, the larger of its
// view's and all views', each from the median (one in 10^8 of normal errors). `fault` is set when
// the typical median exceeds 2 px or 0.1 % of the frame's width.
ViewSelection select_views(const std::vector<BoardView>& views, int width_px, int height_px);

}  // namespace scattermeter::calib
