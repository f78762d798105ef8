#include "core/sums/block_plan.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/even_square.h"

namespace scattermeter {
namespace {

constexpr KernelDipole kDipole{0.5, 1.6, 0.05};

// Rows on the square about its corner (2, 3).
std::vector<Eigen::Vector3d> rows_near(std::size_t count) {
  std::vector<Eigen::Vector3d> rows;
  for (std::size_t i = 0; i < count; ++i) {
    rows.emplace_back(2.0 + 0.05 * static_cast<double>(i % 8),
                      3.0 + 0.05 * static_cast<double>(i / 8), 0.0);
  }
  return rows;
}

std::int32_t points_of(const BlockPlan& plan) {
  std::int32_t count = 0;
  for (const BlockPlan::Run& run : plan.runs) count += run.last - run.first;
  return count;
}

std::int32_t points_of(const std::vector<AcceptedSeries>& accepted, const SourceClusters& sources) {
  std::int32_t count = 0;
  for (const AcceptedSeries& as : accepted) {
    const ClusterNode& node = sources.nodes()[static_cast<std::size_t>(as.node)];
    count += node.last - node.first;
  }
  return count;
}

TEST(BlockPlan, DirectPlanHoldsEveryPoint) {
  const SourceClusters sources = test_support::even_square(500);
  const BlockPlanner planner(sources, {&kDipole, 1}, 1e-3);
  BlockPlan plan;
  planner.plan_direct(plan);
  EXPECT_EQ(points_of(plan), 500);
  EXPECT_TRUE(plan.accepted.empty());
  EXPECT_EQ(plan.error(0, 0, 0), 0.0);
}

// With what is shared or without: the error stays within the limits, a good part of it is used, and
// every point is summed once, be it in a series or by itself.
TEST(BlockPlan, FitUsesTheTolerance) {
  constexpr std::int32_t kPoints = 20000;
  const SourceClusters sources = test_support::even_square(kPoints);
  const RowBlocks rows(rows_near(32));
  int plans_with_shared = 0;
  for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
    const BlockPlanner planner(sources, {&kDipole, 1}, tolerance);
    BlockPlanner::Workspace workspace;
    std::vector<std::vector<PerQuantity>> light;
    for (const RowBlocks::Block& b : rows.blocks()) {
      light.push_back(
          planner.selection().estimate_light({b.center_mm, b.radius_mm}, workspace.selection));
    }
    const SharedPlan shared = planner.plan_shared(rows.blocks(), light, 0.05, workspace);
    for (std::size_t b = 0; b < rows.blocks().size(); ++b) {
      for (const bool with_shared : {true, false}) {
        double share = 0.05;
        BlockPlan plan;
        const bool uses_shared = planner.fit(
            rows.blocks()[b], light[b], with_shared ? &shared : nullptr, share, plan, workspace);
        // What is shared leaves out too much for some blocks.
        EXPECT_LE(uses_shared, with_shared);
        plans_with_shared += uses_shared ? 1 : 0;
        double largest = 0.0;
        for (std::size_t q = 0; q < 3; ++q) {
          EXPECT_DOUBLE_EQ(plan.limits[0][q], tolerance * light[b][0][q]);
          for (std::size_t row = 0; row < kRowLanes; ++row) {
            largest = std::max(largest, plan.error(0, q, row) / plan.limits[0][q]);
          }
        }
        EXPECT_LE(largest, 0.9);
        EXPECT_GE(largest, 0.05);
        const std::int32_t in_series = points_of(plan.accepted, sources) +
                                       (uses_shared ? points_of(shared.accepted, sources) : 0);
        if (workspace.selection.dropped == 0) {
          EXPECT_EQ(in_series + points_of(plan), kPoints);
        }
        EXPECT_GT(in_series, kPoints / 2);
      }
    }
  }
  EXPECT_GT(plans_with_shared, 0);
}

}  // namespace
}  // namespace scattermeter
