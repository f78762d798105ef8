// A sheet of paper with a ChArUco board, and the outline of a piece at a known place beside it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/board/charuco_board.h"
#include "core/mesh/triangle_mesh.h"

namespace scattermeter::apps {

struct SheetRectangle {
  Eigen::Vector2d min_mm, max_mm;
};
struct SheetLine {
  std::vector<Eigen::Vector2d> points_mm;
  double width_mm = 0.2;
  bool white = false;
};
struct SheetText {
  Eigen::Vector2d start_mm;  // left end of the base line
  std::string text;
  double size_mm = 3;
};

// Black on white, lines and texts above rectangles; mm from the lower left corner of the paper, x
// to the right, y up.
struct Sheet {
  double width_mm = 210, height_mm = 297;
  std::vector<SheetRectangle> black;
  std::vector<SheetLine> lines;
  std::vector<SheetText> texts;
};

struct BoardSheet {
  Sheet sheet;
  Eigen::Vector2d board_mm;  // the board's lower left corner on the sheet
  // With a piece: that corner in the world of the piece's mesh (board_beside()).
  std::optional<Eigen::Vector3d> board_in_world_mm;
};

// Where the lower left corner of the board lies in the world of a piece on z = 0, when it is drawn
// in front of the piece's outline (towards -y), mm.
Eigen::Vector3d board_beside(const calib::CharucoBoard& board, const Box3d& piece);

// The names of paper sizes: "A4", "A3", "letter".
const std::vector<std::string>& paper_names();

// The board at the foot of the sheet, above a ruler; above it the outline of the piece seen from
// above, with a cross at the world's origin, white on a black ground (the black stand that a rig
// has by default). The board's world_from_board is not used. Throws InputError where they do not
// fit on the paper, and for a board that board_problem() names.
BoardSheet board_sheet(const calib::CharucoBoard& board, const std::optional<TriangleMesh>& piece,
                       const std::string& paper);

}  // namespace scattermeter::apps
