#include "core/sums/row_blocks.h"

#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(RowBlocks, HoldsEveryRowOnceWithinItsRadius) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  for (const std::size_t n : {1U, 15U, 16U, 17U, 1000U}) {
    std::vector<Eigen::Vector3d> rows;
    for (std::size_t i = 0; i < n; ++i) rows.emplace_back(uniform(random), uniform(random), 1.0);
    rows.back() = rows.front();
    const RowBlocks blocks(rows);
    EXPECT_EQ(blocks.size(), n);
    EXPECT_EQ(blocks.blocks().size(), (n + kRowLanes - 1) / kRowLanes);
    std::vector<int> met(n, 0);
    for (const RowBlocks::Block& b : blocks.blocks()) {
      for (std::size_t i = 0; i < kRowLanes; ++i) {
        const std::size_t row = blocks.order()[b.first + (i < b.count ? i : 0)];
        const Eigen::Vector3d p(b.lanes.x[i], b.lanes.y[i], b.lanes.z[i]);
        EXPECT_EQ(p, rows[row]);
        EXPECT_LE((p - b.center_mm).norm(), b.radius_mm);
        if (i < b.count) ++met[row];
      }
    }
    for (const int count : met) EXPECT_EQ(count, 1);
  }
}

TEST(RowBlocks, EmptyAndBad) {
  EXPECT_TRUE(RowBlocks({}).blocks().empty());
  const std::vector<Eigen::Vector3d> bad = {{0, 0, 0},
                                            {0, std::numeric_limits<double>::quiet_NaN(), 0}};
  EXPECT_THROW(RowBlocks{bad}, std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
