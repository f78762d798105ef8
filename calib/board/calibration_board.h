// The boards that a camera is calibrated with: drawing them and finding them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/board/charuco_board.h"

namespace scattermeter::calib {

enum class BoardKind { kChessboard, kCharuco };

// Frame: origin at the lower left outer corner of the pattern seen from the printed side, x along
// squares_x, y along squares_y. The upper left square is black.
struct CalibrationBoard {
  BoardKind kind = BoardKind::kChessboard;
  int squares_x = 0;  // squares, not inner corners; at least 3 (chessboard: 4, so 3 inner corners)
  int squares_y = 0;
  double square_mm = 0;
  double marker_mm = 0;  // ChArUco only, as the next
  std::string dictionary = "DICT_4X4_50";
};

// What is wrong with the numbers, or "". The functions below throw std::invalid_argument with this
// text where it is not empty.
std::string calibration_board_problem(const CalibrationBoard& board);

// A chessboard's squares alone are a ChArUco board's without markers. Precondition: kCharuco.
CharucoBoard charuco_of(const CalibrationBoard& board);

// The printed pattern: reflectance 0 or 1 at a place on the board, mm; outside: NaN.
class BoardPattern {
 public:
  explicit BoardPattern(const CalibrationBoard& board);
  double reflectance(double x_mm, double y_mm) const;

 private:
  CalibrationBoard board_;
  std::optional<CharucoPattern> charuco_;
};

// Chessboard corners in an image, refined to sub-pixel on the image as given; arguments and scale
// as of find_charuco_corners() (calib/board/charuco_board.h); world_mm is the place on the board.
// A chessboard is found as a whole or not at all, and may be numbered from its other end: it looks
// the same. Its numbers of squares must be right. Detection tries an 8-bit copy of at most 1400 px
// with two tone curves; refinement takes gradients within 0.4 of the way to the nearest corner (at
// most 8 px).
std::vector<PointPair> find_board_corners(const CalibrationBoard& board,
                                          const std::vector<float>& image, int width_px,
                                          int height_px, double px_scale, double px_offset);

}  // namespace scattermeter::calib
