#include "calib/board/charuco_board.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/aruco/charuco.hpp>

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

CharucoBoard board_of(int squares_x, int squares_y) {
  CharucoBoard board;
  board.squares_x = squares_x;
  board.squares_y = squares_y;
  board.square_mm = 6;
  board.marker_mm = 4.5;
  return board;
}

// The print that OpenCV itself draws, at 240 px a square, so that a marker has 180 px and a
// cell 30. Odd and even numbers of rows: OpenCV's pattern once differed between them.
TEST(CharucoPattern, IsWhatOpenCvDraws) {
  for (const auto& [nx, ny] : {std::pair(8, 6), {5, 7}, {7, 4}}) {
    const CharucoBoard board = board_of(nx, ny);
    const CharucoPattern pattern(board);
    cv::Mat drawn;
    cv::aruco::CharucoBoard::create(nx, ny, 6, 4.5F,
                                    cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50))
        ->draw(cv::Size(240 * nx, 240 * ny), drawn);
    int different = 0;
    for (int v = 0; v < drawn.rows; ++v) {
      for (int u = 0; u < drawn.cols; ++u) {
        // Its draw() rounds edges to within 2 px; stay off the edges, which lie at multiples of 30.
        if (std::abs(u % 30 - 15) > 11 || std::abs(v % 30 - 15) > 11) continue;
        const double x_mm = (u + 0.5) / 40;
        const double y_mm = ny * 6 - (v + 0.5) / 40;
        const double expected = drawn.at<unsigned char>(v, u) > 127 ? 1 : 0;
        if (pattern.reflectance(x_mm, y_mm) != expected) ++different;
      }
    }
    EXPECT_EQ(different, 0) << nx << " x " << ny;
  }
}

TEST(CharucoPattern, FrameAndEdges) {
  const CharucoPattern pattern(board_of(5, 4));
  EXPECT_EQ(pattern.reflectance(0.1, 23.9), 0);   // upper left square is black
  EXPECT_EQ(pattern.reflectance(0.1, 0.1), 1);    // lower left of four rows is white
  EXPECT_EQ(pattern.reflectance(0.76, 0.76), 0);  // the marker's black border, from 0.75 mm on
  EXPECT_EQ(pattern.reflectance(0.74, 0.76), 1);
  for (const double outside : {-1e-9, 30 + 1e-9}) {
    EXPECT_TRUE(std::isnan(pattern.reflectance(outside, 5)));
  }
  EXPECT_TRUE(std::isnan(pattern.reflectance(5, 24.001)));
  EXPECT_TRUE(std::isnan(pattern.reflectance(5, -0.001)));
  EXPECT_TRUE(std::isnan(pattern.reflectance(std::nan(""), 5)));
  EXPECT_FALSE(std::isnan(pattern.reflectance(0, 0)));
  EXPECT_FALSE(std::isnan(pattern.reflectance(30, 24)));
}

TEST(BoardProblem, NamesTheField) {
  EXPECT_EQ(board_problem(board_of(8, 6)), "");
  const auto with = [](auto change) {
    CharucoBoard board = board_of(8, 6);
    change(board);
    std::string problem = board_problem(board);
    EXPECT_THROW(CharucoPattern{board}, std::invalid_argument);
    EXPECT_THROW(find_charuco_corners(board, {0}, 1, 1, 1, 0), std::invalid_argument);
    return problem;
  };
  EXPECT_THAT(with([](auto& b) { b.squares_x = 2; }), HasSubstr("2 x 6"));
  EXPECT_THAT(with([](auto& b) { b.squares_y = -6; }), HasSubstr("8 x -6"));
  EXPECT_THAT(with([](auto& b) { b.square_mm = 0; }), HasSubstr("square_mm"));
  EXPECT_THAT(with([](auto& b) { b.marker_mm = 6; }), HasSubstr("marker_mm"));
  EXPECT_THAT(with([](auto& b) { b.marker_mm = std::nan(""); }), HasSubstr("marker_mm"));
  EXPECT_THAT(with([](auto& b) { b.dictionary = "DICT_3X3"; }), HasSubstr("DICT_3X3"));
  EXPECT_THAT(with([](auto& b) { b.squares_x = 18; }), HasSubstr("need 54"));
  EXPECT_THAT(with([](auto& b) { b.squares_x = b.squares_y = std::numeric_limits<int>::max(); }),
              HasSubstr("has 50 markers"));
  EXPECT_THAT(with([](auto& b) { b.world_from_board.rotation.coeffs() *= 2; }),
              HasSubstr("world_from_board"));
}

}  // namespace
}  // namespace scattermeter::calib
