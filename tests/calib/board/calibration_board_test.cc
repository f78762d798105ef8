#include "calib/board/calibration_board.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

TEST(CalibrationBoard, PatternOfAChessboard) {
  const BoardPattern pattern({BoardKind::kChessboard, 6, 5, 10});
  EXPECT_EQ(pattern.reflectance(1, 49), 0);  // upper left
  EXPECT_EQ(pattern.reflectance(11, 49), 1);
  EXPECT_EQ(pattern.reflectance(11, 39), 0);
  EXPECT_EQ(pattern.reflectance(60, 50), 1);  // the corners belong to the board
  EXPECT_TRUE(std::isnan(pattern.reflectance(60.001, 50)));
  EXPECT_TRUE(std::isnan(pattern.reflectance(5, -0.001)));
}

TEST(CalibrationBoard, PatternOfACharucoBoardIsItsOwn) {
  const CalibrationBoard board{BoardKind::kCharuco, 6, 5, 10, 7, "DICT_4X4_50"};
  const BoardPattern pattern(board);
  const CharucoPattern charuco(charuco_of(board));
  for (double x = 0.3; x < 60; x += 0.7) {
    for (double y = 0.2; y < 50; y += 0.9) {
      EXPECT_EQ(pattern.reflectance(x, y), charuco.reflectance(x, y));
    }
  }
}

TEST(CalibrationBoard, ProblemsAreNamed) {
  EXPECT_EQ(calibration_board_problem({BoardKind::kChessboard, 10, 7, 30}), "");
  EXPECT_THAT(calibration_board_problem({BoardKind::kChessboard, 3, 7, 30}), HasSubstr("3 x 7"));
  EXPECT_THAT(calibration_board_problem(
                  {BoardKind::kChessboard, 10, 7, std::numeric_limits<double>::infinity()}),
              HasSubstr("square_mm"));
  EXPECT_THAT(calibration_board_problem({BoardKind::kCharuco, 10, 7, 30, 40}),
              HasSubstr("marker_mm"));
  EXPECT_THROW(BoardPattern({BoardKind::kChessboard, 3, 7, 30}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
