#include "core/view/adjacent_rows.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

using Lists = std::vector<std::vector<std::int32_t>>;

// 0 0 1 1
// 0 . 1 2
// . . . 2
TEST(AdjacentRows, BesideAndDiagonal) {
  const std::vector<std::int32_t> rows = {0, 0, 1, 1, 0, -1, 1, 2, -1, -1, -1, 2};
  EXPECT_EQ(adjacent_rows(rows, 4, 3, 3), (Lists{{1}, {0, 2}, {1}}));
  // Touching by a corner only.
  EXPECT_EQ(adjacent_rows({0, -1, -1, 1}, 2, 2, 2), (Lists{{1}, {0}}));
  EXPECT_EQ(adjacent_rows({-1, 0, 1, -1}, 2, 2, 2), (Lists{{1}, {0}}));
}

// Samples in no row part what they lie between, and the lines of the picture do not run on.
TEST(AdjacentRows, NoneAcrossAGap) {
  EXPECT_EQ(adjacent_rows({0, -1, 1}, 3, 1, 2), (Lists{{}, {}}));
  EXPECT_EQ(adjacent_rows({-1, -1, 0, 1, -1, -1}, 3, 2, 2), (Lists{{}, {}}));
}

TEST(AdjacentRows, RefusesWhatDoesNotFit) {
  EXPECT_THROW(adjacent_rows({0, 0}, 3, 1, 1), std::invalid_argument);
  EXPECT_THROW(adjacent_rows({0, 1}, 2, 1, 1), std::invalid_argument);
  EXPECT_TRUE(adjacent_rows({}, 0, 0, 0).empty());
}

}  // namespace
}  // namespace scattermeter
