// find_charuco_corners(): detection on a tone-mapped 8-bit copy, refinement on the image itself.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "calib/board/charuco_opencv.h"
#include "calib/board/opencv_quiet.h"
#include "calib/board/tone_picture.h"

namespace scattermeter::calib {
namespace {

namespace aruco = cv::aruco;

struct Detection {
  std::vector<cv::Point2f> corners;
  std::vector<int> ids;
  // Shortest side of the detected markers, px; it determines the half-widths of the refinement
  // windows.
  double marker_side_px = 0;
};

Detection detect(const cv::Mat& picture, const cv::Ptr<aruco::CharucoBoard>& board) {
  Detection out;
  std::vector<std::vector<cv::Point2f>> markers;
  std::vector<int> ids;
  const cv::Ptr<aruco::DetectorParameters> parameters = aruco::DetectorParameters::create();
  // The default requires a perimeter of 3 % of the longer side of the frame; boards of many squares
  // in the background of a 10-megapixel frame have smaller markers that can still be decoded.
  parameters->minMarkerPerimeterRate = 0.015;
  aruco::detectMarkers(picture, board->dictionary, markers, ids, parameters);
  if (markers.empty()) return out;
  aruco::interpolateCornersCharuco(markers, ids, picture, board, out.corners, out.ids);
  out.marker_side_px = 1e9;
  const int board_markers = static_cast<int>(board->ids.size());
  for (size_t i = 0; i < markers.size(); ++i) {
    if (ids[i] >= board_markers) continue;  // a marker of another board
    const std::vector<cv::Point2f>& marker = markers[i];
    for (size_t k = 0; k < 4; ++k) {
      out.marker_side_px = std::min(out.marker_side_px, cv::norm(marker[k] - marker[(k + 1) % 4]));
    }
  }
  return out;
}

}  // namespace

std::vector<PointPair> find_charuco_corners(const CharucoBoard& board,
                                            const std::vector<float>& image, int width_px,
                                            int height_px, double px_scale, double px_offset) {
  const cv::Ptr<aruco::CharucoBoard> print = opencv_board(board);
  if (width_px <= 0 || height_px <= 0 ||
      image.size() != static_cast<size_t>(width_px) * static_cast<size_t>(height_px)) {
    throw std::invalid_argument("find_charuco_corners: " + std::to_string(image.size()) +
                                " samples for " + std::to_string(width_px) + " x " +
                                std::to_string(height_px) + " px");
  }
  if (!(std::isfinite(px_scale) && px_scale > 0) || !std::isfinite(px_offset)) {
    throw std::invalid_argument("find_charuco_corners: px_scale must be positive and finite, got " +
                                std::to_string(px_scale));
  }
  const cv::Mat_<float> stretched = stretched_image(image, width_px, height_px);
  if (stretched.empty()) return {};

  const OpencvQuiet quiet;
  try {
    Detection found;
    for (float (*curve)(float) : {&gamma_curve, &steep_curve}) {
      Detection next = detect(to_8_bit(stretched, curve), print);
      if (next.ids.size() > found.ids.size()) found = std::move(next);
      if (found.ids.size() == print->chessboardCorners.size()) break;
    }
    if (found.ids.empty()) return {};

    // The window must not reach the markers, which begin (square - marker) / 2 from a corner.
    const double clear_px =
        0.5 * (board.square_mm - board.marker_mm) / board.marker_mm * found.marker_side_px;
    const int half_window = std::clamp(static_cast<int>(0.9 * clear_px), 2, 12);
    std::vector<cv::Point2f> refined = found.corners;
    cv::cornerSubPix(stretched, refined, cv::Size(half_window, half_window), cv::Size(-1, -1),
                     cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-4));

    std::vector<PointPair> pairs;
    for (size_t i = 0; i < refined.size(); ++i) {
      // A window that extends beyond the frame is padded with copies of the edge.
      const cv::Point2f p = refined[i];
      const auto margin = static_cast<float>(half_window + 1);
      const bool inside = p.x >= margin && p.y >= margin &&
                          p.x <= static_cast<float>(width_px - 1) - margin &&
                          p.y <= static_cast<float>(height_px - 1) - margin;
      if (!inside || found.ids[i] < 0) continue;
      const int corner = found.ids[i];  // counts row by row from the upper left inner corner
      const int column = corner % (board.squares_x - 1) + 1;
      const int row = corner / (board.squares_x - 1) + 1;
      const Eigen::Vector3d x_in_board_mm(column * board.square_mm,
                                          (board.squares_y - row) * board.square_mm, 0);
      pairs.push_back({board.world_from_board * x_in_board_mm,
                       {px_scale * static_cast<double>(p.x) + px_offset,
                        px_scale * static_cast<double>(p.y) + px_offset}});
    }
    return pairs;
  } catch (const cv::Exception& error) {
    throw std::runtime_error("find_charuco_corners: OpenCV: " + error.err);
  }
}

}  // namespace scattermeter::calib
