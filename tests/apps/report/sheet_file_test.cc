#include "apps/report/sheet_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/board/grey_picture.h"
#include "core/base/input_error.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// The picture's corners are found where the sheet has them, to a hundredth of a mm.
TEST(SheetFile, BoardIsFoundInItsPicture) {
  const TemporaryFolder folder;
  calib::CharucoBoard board;
  board.squares_x = 10;
  board.squares_y = 7;
  board.square_mm = 6.0;
  board.marker_mm = 4.5;
  const BoardSheet drawn = board_sheet(board, std::nullopt, "A4");
  write_sheet(folder / "board.png", drawn.sheet);
  const calib::GreyPicture picture = calib::read_grey_picture(folder / "board.png", 100.0);
  EXPECT_EQ(picture.width_px, 4961);  // 210 mm at 600 dots per inch
  EXPECT_EQ(picture.height_px, 7016);
  const std::vector<PointPair> corners = calib::find_charuco_corners(
      board, picture.grey, picture.width_px, picture.height_px, 1.0, 0.0);
  ASSERT_EQ(corners.size(), 54U);
  for (const PointPair& c : corners) {
    // Pixel (0, 0) is the centre of the first.
    const Eigen::Vector2d mm = (c.image_px + Eigen::Vector2d(0.5, 0.5)) * 25.4 / 600.0;
    const Eigen::Vector2d on_sheet(mm.x(), drawn.sheet.height_mm - mm.y());
    EXPECT_LT((on_sheet - drawn.board_mm - c.world_mm.head<2>()).norm(), 0.01);
  }
}

// A4 in points of 1/72 inch.
TEST(SheetFile, PdfHasItsSize) {
  const TemporaryFolder folder;
  Sheet sheet;
  sheet.black = {{{10, 10}, {20, 20}}};
  sheet.texts = {{{10, 30}, "text", 3}};
  write_sheet(folder / "a.pdf", sheet);
  const std::string bytes = slurp(folder / "a.pdf");
  EXPECT_THAT(bytes, StartsWith("%PDF-"));
  EXPECT_THAT(bytes, HasSubstr("595.27"));
  EXPECT_THAT(bytes, HasSubstr("841.88"));
  EXPECT_THROW(write_sheet(folder / "a.jpg", sheet), InputError);
}

}  // namespace
}  // namespace scattermeter::apps
