#include "calib/pose/cell_means.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

// 11 x 13 samples at (1, 2) of the frame whose signal is 100 y + x, by the frame's coordinates.
CfaSamples numbered() {
  CfaSamples s;
  s.x0 = 1;
  s.y0 = 2;
  s.width = 11;
  s.height = 13;
  s.channel_of_phase = {0, 1, 1, 2};
  s.exposure_s = 0.3;
  s.variance_per_count = 0.5;
  s.floor_counts = 7;
  for (int y = 2; y < 15; ++y) {
    for (int x = 1; x < 12; ++x) {
      s.signal_counts.push_back(static_cast<float>(100 * y + x));
      s.variance_counts2.push_back(8.0F);
      s.clipped.push_back(x == 9 && y == 5 ? kSampleDefect : 0);
    }
  }
  return s;
}

// Cells count from the frame's corner: of 4 x 4, those from (4, 4) to (12, 12) are whole.
TEST(CellMeans, AreThoseOfWholeCells) {
  const CfaSamples cells = cell_means(numbered(), 4);
  EXPECT_EQ(cells.x0, 1);
  EXPECT_EQ(cells.y0, 1);
  ASSERT_EQ(cells.width, 2);
  ASSERT_EQ(cells.height, 2);
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const auto at = static_cast<std::size_t>(2 * j + i);
      EXPECT_FLOAT_EQ(cells.signal_counts[at],
                      static_cast<float>(100 * (5.5 + 4 * j) + 5.5 + 4 * i));
      EXPECT_FLOAT_EQ(cells.variance_counts2[at], 8.0F / 16);
    }
  }
  EXPECT_EQ(cells.channel(3, 4), 1);
  EXPECT_EQ(cells.exposure_s, 0.3);
  EXPECT_EQ(cells.floor_counts, 7);
  EXPECT_EQ(cells.variance_per_count, 0.5 / 16);
}

TEST(CellMeans, AClippedSampleClipsItsCell) {
  const CfaSamples cells = cell_means(numbered(), 4);
  EXPECT_EQ(cells.clipped, (std::vector<std::uint8_t>{0, kSampleDefect, 0, 0}));
}

TEST(CellMeans, CellsLargerThanThePictureAreNone) {
  const CfaSamples cells = cell_means(numbered(), 16);
  EXPECT_EQ(cells.width, 0);
  EXPECT_TRUE(cells.signal_counts.empty());
}

TEST(CellMeans, NeedsAnEvenFactor) {
  EXPECT_THROW(cell_means(numbered(), 3), std::invalid_argument);
  EXPECT_THROW(cell_means(numbered(), 0), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
