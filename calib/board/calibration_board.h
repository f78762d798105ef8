// Boards for camera calibration: their printed patterns and the detection of their corners.
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
  double marker_mm = 0;  // ChArUco only, like the dictionary
  std::string dictionary = "DICT_4X4_50";
};

// What is wrong with the numbers, or "". The functions below throw std::invalid_argument with this
// text if it is not empty.
std::string calibration_board_problem(const CalibrationBoard& board);

// The ChArUco board with these numbers. Precondition: kCharuco.
CharucoBoard charuco_of(const CalibrationBoard& board);

// The printed pattern: reflectance 0 or 1 at a position on the board in mm, NaN outside the board.
class BoardPattern {
 public:
  explicit BoardPattern(const CalibrationBoard& board);
  double reflectance(double x_mm, double y_mm) const;

 private:
  CalibrationBoard board_;
  std::optional<CharucoPattern> charuco_;
};

// The board's corners in an image, refined to sub-pixel accuracy on the image as given. Arguments
// and scale are those of find_charuco_corners() (calib/board/charuco_board.h); world_mm is the
// position on the board. A chessboard is found as a whole or not at all, and its corners may be
// numbered from the opposite end, as it looks the same when turned by half a turn. Its numbers of
// squares must be right. Detection uses an 8-bit copy of at most 1400 px with two tone curves;
// refinement uses the gradients within 0.4 of the distance to the nearest corner (at most 8 px).
std::vector<PointPair> find_board_corners(const CalibrationBoard& board,
                                          const std::vector<float>& image, int width_px,
                                          int height_px, double px_scale, double px_offset);

}  // namespace scattermeter::calib
