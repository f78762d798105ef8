// find_board_corners(): corners of chessboards; ChArUco boards have find_charuco_corners().
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/board/calibration_board.h"
#include "calib/board/opencv_quiet.h"
#include "calib/board/tone_picture.h"

namespace scattermeter::calib {
namespace {

constexpr int kDetectionPx = 1400;  // longer side of the picture that is searched
constexpr double kWindow = 0.4;     // half-width, over the distance to the nearest corner
constexpr int kMaxHalfWindowPx = 8;

// Corners to a few tenths of a pixel, row by row; empty when the board is not seen.
std::vector<cv::Point2f> rough_corners(const cv::Mat_<float>& stretched, const cv::Size& corners) {
  const double shrink =
      std::max(1.0, std::max(stretched.cols, stretched.rows) / static_cast<double>(kDetectionPx));
  cv::Mat_<float> small = stretched;
  if (shrink > 1) cv::resize(stretched, small, {}, 1 / shrink, 1 / shrink, cv::INTER_AREA);
  const double scale_x = stretched.cols / static_cast<double>(small.cols);
  const double scale_y = stretched.rows / static_cast<double>(small.rows);
  std::vector<cv::Point2f> found;
  bool seen = false;
  for (float (*curve)(float) : {&gamma_curve, &steep_curve}) {
    const cv::Mat picture = to_8_bit(small, curve);
    seen = cv::findChessboardCorners(
        picture, corners, found,
        cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK);
    if (seen) break;
  }
  // Slower, but also finds blurred and small squares.
  if (!seen) {
    seen = cv::findChessboardCornersSB(to_8_bit(small, gamma_curve), corners, found,
                                       cv::CALIB_CB_NORMALIZE_IMAGE);
  }
  if (!seen) return {};
  for (cv::Point2f& p : found) {
    p.x = static_cast<float>((static_cast<double>(p.x) + 0.5) * scale_x - 0.5);
    p.y = static_cast<float>((static_cast<double>(p.y) + 0.5) * scale_y - 0.5);
  }
  return found;
}

// The window must not contain gradients of other corners and must not extend beyond the image.
std::optional<cv::Point2f> refined(const cv::Mat_<float>& stretched,
                                   const std::vector<cv::Point2f>& rough, std::size_t i) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < rough.size(); ++k) {
    if (k != i) nearest = std::min(nearest, cv::norm(rough[k] - rough[i]));
  }
  const cv::Point2f p = rough[i];
  const auto edge =
      static_cast<double>(std::min({p.x, p.y, static_cast<float>(stretched.cols - 1) - p.x,
                                    static_cast<float>(stretched.rows - 1) - p.y}));
  const int half = std::min({kMaxHalfWindowPx, static_cast<int>(kWindow * nearest),
                             static_cast<int>(std::floor(edge)) - 2});
  if (half < 2) return std::nullopt;
  std::vector<cv::Point2f> one = {p};
  cv::cornerSubPix(stretched, one, cv::Size(half, half), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-4));
  return one.front();
}

}  // namespace

std::vector<PointPair> find_board_corners(const CalibrationBoard& board,
                                          const std::vector<float>& image, int width_px,
                                          int height_px, double px_scale, double px_offset) {
  if (board.kind == BoardKind::kCharuco) {
    return find_charuco_corners(charuco_of(board), image, width_px, height_px, px_scale, px_offset);
  }
  if (const std::string problem = calibration_board_problem(board); !problem.empty()) {
    throw std::invalid_argument("board: " + problem);
  }
  if (width_px <= 0 || height_px <= 0 ||
      image.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("find_board_corners: " + std::to_string(image.size()) +
                                " samples for " + std::to_string(width_px) + " x " +
                                std::to_string(height_px) + " px");
  }
  if (!(std::isfinite(px_scale) && px_scale > 0) || !std::isfinite(px_offset)) {
    throw std::invalid_argument("find_board_corners: px_scale must be positive and finite, got " +
                                std::to_string(px_scale));
  }
  const cv::Mat_<float> stretched = stretched_image(image, width_px, height_px);
  if (stretched.empty()) return {};
  const OpencvQuiet quiet;
  try {
    const int columns = board.squares_x - 1;
    const std::vector<cv::Point2f> rough =
        rough_corners(stretched, cv::Size(columns, board.squares_y - 1));
    std::vector<PointPair> pairs;
    for (std::size_t i = 0; i < rough.size(); ++i) {
      const std::optional<cv::Point2f> p = refined(stretched, rough, i);
      if (!p) continue;
      const int column = static_cast<int>(i) % columns + 1;
      const int row = static_cast<int>(i) / columns + 1;
      pairs.push_back({{column * board.square_mm, (board.squares_y - row) * board.square_mm, 0},
                       {px_scale * static_cast<double>(p->x) + px_offset,
                        px_scale * static_cast<double>(p->y) + px_offset}});
    }
    return pairs;
  } catch (const cv::Exception& error) {
    throw std::runtime_error("find_board_corners: OpenCV: " + error.err);
  }
}

}  // namespace scattermeter::calib
