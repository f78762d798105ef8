#include "calib/board/calibration_board.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace scattermeter::calib {

std::string calibration_board_problem(const CalibrationBoard& board) {
  if (board.kind == BoardKind::kCharuco) return board_problem(charuco_of(board));
  std::ostringstream out;
  if (board.squares_x < 4 || board.squares_y < 4) {
    out << "squares of a chessboard must be at least 4 x 4, got " << board.squares_x << " x "
        << board.squares_y;
  } else if (!(board.square_mm > 0) || !std::isfinite(board.square_mm)) {
    out << "square_mm must be positive and finite, got " << board.square_mm;
  }
  return out.str();
}

CharucoBoard charuco_of(const CalibrationBoard& board) {
  CharucoBoard out;
  out.squares_x = board.squares_x;
  out.squares_y = board.squares_y;
  out.square_mm = board.square_mm;
  out.marker_mm = board.marker_mm;
  out.dictionary = board.dictionary;
  return out;
}

BoardPattern::BoardPattern(const CalibrationBoard& board) : board_(board) {
  const std::string problem = calibration_board_problem(board);
  if (!problem.empty()) throw std::invalid_argument("board: " + problem);
  if (board.kind == BoardKind::kCharuco) charuco_.emplace(charuco_of(board));
}

double BoardPattern::reflectance(double x_mm, double y_mm) const {
  if (charuco_) return charuco_->reflectance(x_mm, y_mm);
  const double across = x_mm / board_.square_mm;
  const double down = board_.squares_y - y_mm / board_.square_mm;
  if (!(across >= 0 && across <= board_.squares_x && down >= 0 && down <= board_.squares_y)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const int column = std::min(static_cast<int>(across), board_.squares_x - 1);
  const int row = std::min(static_cast<int>(down), board_.squares_y - 1);
  return (column + row) % 2 == 0 ? 0 : 1;
}

}  // namespace scattermeter::calib
