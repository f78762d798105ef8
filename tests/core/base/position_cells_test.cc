#include "core/base/position_cells.h"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(PositionCells, AreAlikeInSizeAndInOnePlace) {
  std::vector<Eigen::Vector3d> centers;
  for (int i = 0; i < 32; ++i) {
    for (int j = 0; j < 8; ++j) centers.emplace_back(i, j, 0.0);
  }
  const std::vector<int> cell = position_cells(centers, 2, 10);
  std::vector<int> count(4, 0);
  for (const int c : cell) ++count.at(static_cast<std::size_t>(c));
  EXPECT_EQ(count, (std::vector<int>{64, 64, 64, 64}));
  // Strips along the long side.
  for (std::size_t k = 0; k < centers.size(); ++k) {
    EXPECT_EQ(cell[k], static_cast<int>(centers[k].x()) / 8);
  }
  // Too few rows to cut, and points that are all the same.
  EXPECT_EQ(position_cells(centers, 4, 200), std::vector<int>(256, 0));
  const std::vector<int> same = position_cells(std::vector<Eigen::Vector3d>(40, {1, 1, 1}), 1, 20);
  EXPECT_EQ(std::count(same.begin(), same.end(), 0), 20);
  EXPECT_TRUE(position_cells({}, 3, 1).empty());
  EXPECT_THROW(position_cells(centers, -1, 1), std::invalid_argument);
  EXPECT_THROW(position_cells(centers, 1, 0), std::invalid_argument);
}

TEST(PositionCells, SquaresOfSums) {
  const CellSquares found =
      squares_of_sums({0, 2, 0, 2, 2}, (Eigen::VectorXd(5) << 1, -1, 2, 4, 3).finished());
  EXPECT_DOUBLE_EQ(found.squares, 9.0 / 2.0 + 36.0 / 3.0);
  EXPECT_EQ(found.cells, 2.0);
  EXPECT_EQ(squares_of_sums({}, {}).cells, 0.0);
}

}  // namespace
}  // namespace scattermeter
