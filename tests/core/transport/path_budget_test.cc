#include "core/transport/path_budget.h"

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr double kHour_s = 3600.0;

std::int64_t thousand_each(int blocks) { return 1000 * std::int64_t{blocks}; }

TEST(PathBudget, BlocksAreLimited) {
  PathBudget budget(300.0, kHour_s);
  budget.count(1'000'000, 1.0);
  EXPECT_GT(budget.left_s(), 0.0);
  EXPECT_EQ(budget.next_blocks(100, 64, thousand_each), 200);
  EXPECT_EQ(budget.next_blocks(180, 64, thousand_each), 270);
  EXPECT_EQ(budget.next_blocks(230, 64, thousand_each), 287);
  EXPECT_EQ(budget.next_blocks(250, 64, thousand_each), 0);
  EXPECT_EQ(budget.with(1e6).next_blocks(250, 64, thousand_each), 500);
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

// 10^5 paths found; there is time for 60, 40 and 60 thousand more, or for 40 of which 60 were
// traced by this search.
TEST(PathBudget, AFewMorePathsThanWereFoundAreNotWorthTheTime) {
  const auto budget = [](double seconds) {
    PathBudget out(1e6, seconds);
    out.count(1, 1e-5);  // 10^5 a second
    return out;
  };
  const auto missing = [](int blocks) { return 1000 * std::int64_t{blocks - 100}; };
  EXPECT_EQ(budget(0.6).next_blocks(100, 64, missing), 150);
  EXPECT_EQ(budget(0.4).next_blocks(100, 64, missing), 0);
  EXPECT_EQ(budget(0.4).next_blocks(100, 128, missing), 125);
  PathBudget own(1e6, 0.4);
  own.count(60'000, 0.6);
  EXPECT_EQ(own.next_blocks(100, 64, missing), 125);
}

// 100, 200, 300 blocks of at most 300, or those for which there is time: 10^5 paths in a second.
TEST(PathBudget, ForeseesHowASearchEnds) {
  PathBudget budget(300.0, kHour_s);
  budget.count(1'000'000, 1.0);
  EXPECT_EQ(budget.final_blocks(100, 64, 512, thousand_each), 300);
  EXPECT_EQ(budget.final_blocks(100, 64, 240, thousand_each), 240);
  EXPECT_EQ(budget.final_blocks(600, 64, 512, thousand_each), 600);
  PathBudget short_time(1e6, 1.0);
  short_time.count(1, 1e-5);
  EXPECT_EQ(short_time.final_blocks(40, 64, 512, thousand_each), 80);
  EXPECT_EQ(PathBudget(1e6, 0.0).final_blocks(40, 64, 512, thousand_each), 40);
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
