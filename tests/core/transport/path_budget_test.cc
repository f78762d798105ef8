#include "core/transport/path_budget.h"

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr double kHour_s = 3600.0;

std::int64_t thousand_each(int blocks) { return 1000 * std::int64_t{blocks}; }

TEST(PathBudget, BlocksAreLimited) {
  const PathBudget budget(300.0, kHour_s);
  EXPECT_GT(budget.left_s(), 0.0);
  EXPECT_EQ(budget.next_blocks(100, 64, thousand_each), 200);
  EXPECT_EQ(budget.next_blocks(180, 64, thousand_each), 270);
  EXPECT_EQ(budget.next_blocks(230, 64, thousand_each), 287);
  EXPECT_EQ(budget.next_blocks(250, 64, thousand_each), 0);
}

TEST(PathBudget, TimeLimitsThemByTheSpeedSoFar) {
  PathBudget fast(1e6, kHour_s), slow(1e6, kHour_s);
  // What is left after an hour at 10^6 paths in a second, and in a year.
  fast.count(1'000'000, 1.0);
  slow.count(1'000'000, 3e7);
  EXPECT_EQ(fast.next_blocks(100, 64, thousand_each), 200);
  EXPECT_EQ(slow.next_blocks(100, 64, thousand_each), 0);
  EXPECT_LE(PathBudget(1e6, 0.0).left_s(), 0.0);
  // Before any path: kUnknownPathsPerS, of which there are 10^5 in a second.
  EXPECT_EQ(PathBudget(1e6, 1.0).next_blocks(40, 64, thousand_each), 80);
  EXPECT_EQ(PathBudget(1e6, 1.0).next_blocks(100, 64, thousand_each), 0);
}

TEST(PathBudget, TellsWhetherPathsFitIntoTimesItsLimit) {
  PathBudget budget(1e6, 100.0);
  budget.count(1'000'000, 1.0);
  EXPECT_TRUE(budget.has_time_for(90'000'000));
  EXPECT_FALSE(budget.has_time_for(110'000'000));
  EXPECT_TRUE(budget.has_time_for(110'000'000, 1.5));
  EXPECT_FALSE(budget.has_time_for(160'000'000, 1.5));
}

}  // namespace
}  // namespace scattermeter
