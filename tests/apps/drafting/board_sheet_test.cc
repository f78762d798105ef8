#include "apps/drafting/board_sheet.h"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/drafting/drafted_body.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

calib::CharucoBoard sheet_board(const std::string& dictionary = "DICT_4X4_50") {
  calib::CharucoBoard board;
  board.squares_x = 10;
  board.squares_y = 7;
  board.square_mm = 6.0;
  board.marker_mm = 4.5;
  board.dictionary = dictionary;
  return board;
}

// At random points of the board, and around it.
TEST(BoardSheet, IsThePattern) {
  for (const char* dictionary : {"DICT_4X4_50", "DICT_7X7_100", "DICT_APRILTAG_36h11"}) {
    const calib::CharucoBoard board = sheet_board(dictionary);
    const BoardSheet drawn = board_sheet(board, std::nullopt, "A4");
    EXPECT_FALSE(drawn.board_in_world_mm.has_value());
    const calib::CharucoPattern pattern(board);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> x(-5.0, 65.0), y(-5.0, 47.0);
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector2d p(x(random), y(random));
      const Eigen::Vector2d at = drawn.board_mm + p;
      const bool black = std::any_of(
          drawn.sheet.black.begin(), drawn.sheet.black.end(), [&](const SheetRectangle& r) {
            return (at.array() >= r.min_mm.array()).all() && (at.array() <= r.max_mm.array()).all();
          });
      EXPECT_EQ(black, pattern.reflectance(p.x(), p.y()) == 0.0) << dictionary << p.transpose();
    }
  }
}

// A box of 30 x 20 mm: its outline lies 8 mm above the board, around the cross at the origin.
TEST(BoardSheet, TellsWhereThePieceStands) {
  const BoardSheet drawn = board_sheet(sheet_board(), drafted_body("box:30x20x10").mesh, "A4");
  ASSERT_TRUE(drawn.board_in_world_mm.has_value());
  EXPECT_LT((*drawn.board_in_world_mm - Eigen::Vector3d(-30.0, -10.0 - 8.0 - 42.0, 0.0)).norm(),
            1e-9);
  const auto outline =
      std::find_if(drawn.sheet.lines.begin(), drawn.sheet.lines.end(),
                   [](const SheetLine& line) { return line.points_mm.size() == 5; });
  ASSERT_NE(outline, drawn.sheet.lines.end());
  EXPECT_EQ(outline->points_mm.front(), outline->points_mm.back());
  EXPECT_TRUE(outline->white);
  const SheetRectangle& ground = drawn.sheet.black.back();
  EXPECT_GT(ground.min_mm.y(), drawn.board_mm.y() + 42.0 + 3.0);  // a white border of 3 mm
  for (const Eigen::Vector2d& p : outline->points_mm) {
    const Eigen::Vector2d world = p - drawn.board_mm + drawn.board_in_world_mm->head<2>();
    EXPECT_LT((world.cwiseAbs() - Eigen::Vector2d(15.0, 10.0)).norm(), 1e-9);
    EXPECT_TRUE((p.array() > ground.min_mm.array() + 4.0).all());
    EXPECT_TRUE((p.array() < ground.max_mm.array() - 4.0).all());
  }
}

TEST(BoardSheet, TheRulerHasItsLength) {
  const Sheet sheet = board_sheet(sheet_board(), std::nullopt, "A4").sheet;
  const Eigen::Vector2d along = sheet.lines[0].points_mm[1] - sheet.lines[0].points_mm[0];
  EXPECT_EQ(along, Eigen::Vector2d(180.0, 0.0));
  EXPECT_THAT(sheet.texts[0].text, HasSubstr("180 mm"));
}

TEST(BoardSheet, SaysWhatDoesNotFit) {
  calib::CharucoBoard board = sheet_board();
  board.square_mm = 30.0;
  EXPECT_THAT([&] { board_sheet(board, std::nullopt, "A4"); },
              ThrowsMessage<InputError>(HasSubstr("324 x ")));
  EXPECT_THAT([&] { board_sheet(sheet_board(), std::nullopt, "A0"); },
              ThrowsMessage<InputError>(HasSubstr("A4, A3, letter")));
  EXPECT_THAT([&] { board_sheet(sheet_board("DICT_3X3"), std::nullopt, "A4"); },
              ThrowsMessage<InputError>(HasSubstr("--dictionary")));
}

}  // namespace
}  // namespace scattermeter::apps
