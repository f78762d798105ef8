// Selection of the views of a board, and of their corners, that a calibration can use.
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
  double distance_px = 0;  // from the position that the others predict
};

struct ViewSelection {
  std::vector<BoardView> views;  // with the corners used
  CameraBundle bundle;           // of these views
  std::vector<LeftOutView> left_out;
  std::vector<LeftOutCorner> corners_left_out;
  // Why the views cannot be used together (their corners are not consistent with any camera), or
  // "".
  std::string fault;
};

// In this order, a view is left out when
// - it has fewer than eight corners, or they lie on a line;
// - its corners equal those of another view to 1e-3 px: a shot given twice counts once;
// - no perspective maps 7 in 10 of its corners to within 2 % of the frame width: they are not those
//   of this board;
// - in the joint fit with Cauchy's loss its median residual is more than four times the median of
//   all views' medians (the worst view goes first, then the fit is repeated); a view that fits
//   later on is taken back;
// - more than a quarter of its corners are left out.
// A corner is left out when its residual exceeds six standard deviations (one normal error in
// 10^8), the larger of that of its view and that of all views, each derived from the median.
// `fault` is set when the typical median exceeds 2 px or 0.1 % of the frame's width.
ViewSelection select_views(const std::vector<BoardView>& views, int width_px, int height_px);

}  // namespace scattermeter::calib
