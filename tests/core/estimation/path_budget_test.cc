#include "core/estimation/path_budget.h"

#include <gtest/gtest.h>

#include "tests/fixtures/core/simulated_cube.h"

namespace scattermeter {
namespace {

using test_support::kSimulated;
using test_support::SimulatedCube;

constexpr double kHour_s = 3600.0;

EstimateOptions budget_of(double blocks, double time_limit_s) {
  EstimateOptions options;
  options.paths = static_cast<std::int64_t>(blocks * ChannelSimulation::kBlockPaths);
  options.time_limit_s = time_limit_s;
  return options;
}

TEST(PathBudget, PathsLimitTheBlocks) {
  const SimulatedCube c;
  const EstimateOptions options = budget_of(300, kHour_s);
  const PathBudget budget(options);
  EXPECT_GT(budget.left_s(), 0.0);
  EXPECT_EQ(budget.next_blocks(*c.simulation, kSimulated, 100), 200);
  EXPECT_EQ(budget.next_blocks(*c.simulation, kSimulated, 180), 270);
  EXPECT_EQ(budget.next_blocks(*c.simulation, kSimulated, 230), 287);
  EXPECT_EQ(budget.next_blocks(*c.simulation, kSimulated, 250), 0);
}

TEST(PathBudget, TimeLimitsThemByTheSpeedSoFar) {
  const SimulatedCube c;
  const EstimateOptions options = budget_of(1e6, kHour_s);
  PathBudget fast(options), slow(options);
  // What is left after an hour at 10^6 paths in a second, and in a year.
  fast.count(1'000'000, 1.0);
  slow.count(1'000'000, 3e7);
  EXPECT_EQ(fast.next_blocks(*c.simulation, kSimulated, 100), 200);
  EXPECT_EQ(slow.next_blocks(*c.simulation, kSimulated, 100), 0);
  const EstimateOptions none = budget_of(1e6, 0.0);
  EXPECT_LE(PathBudget(none).left_s(), 0.0);
}

}  // namespace
}  // namespace scattermeter
