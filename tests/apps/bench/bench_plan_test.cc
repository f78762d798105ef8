#include "apps/bench/bench_plan.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/draws.h"

namespace scattermeter::apps {
namespace {

// Rigs drawn at random: what `plan` forecasts is what measuring states.
TEST(BenchPlanStatistics, RandomRigs) {
  PlanBenchOptions options;
  options.rigs = test_support::draws(5, 20);
  options.image_width_px = 320;

  const std::vector<PlanBenchRow> rows = bench_plan(options);
  ASSERT_EQ(rows.size(), 3U * static_cast<std::size_t>(options.rigs));
  const PlanBenchRatios ratios = plan_bench_ratios(rows);
  EXPECT_GT(ratios.n, rows.size() * 4U / 3U);  // most are measured, two coefficients each
  std::printf("forecast over stated: median %.3f, %.2f to %.2f of %zu\n", ratios.median,
              ratios.least, ratios.most, ratios.n);
  EXPECT_GT(ratios.median, 0.9);
  EXPECT_LT(ratios.median, 1.1);
  EXPECT_GT(ratios.least, 0.7);
  EXPECT_LT(ratios.most, 1.4);
  int differ = 0;
  for (const PlanBenchRow& row : rows) {
    differ += row.planned == row.measured ? 0 : 1;
    EXPECT_EQ(row.reasons.empty(), row.planned == row.measured) << row.rig;
    for (const std::string& reason : row.reasons) {
      EXPECT_NE(plan_bench_table(rows).find(reason), std::string::npos);
    }
  }
  EXPECT_LE(differ, 3) << plan_bench_table(rows);
}

TEST(BenchPlan, RatiosByHand) {
  PlanBenchRow a;
  a.forecast_sigma_s_prime = 0.02;
  a.stated_sigma_s_prime = 0.01;
  a.forecast_sigma_a = std::numeric_limits<double>::quiet_NaN();
  a.stated_sigma_a = 0.1;
  PlanBenchRow b = a;
  b.forecast_sigma_s_prime = 0.01;
  b.forecast_sigma_a = 0.05;
  const PlanBenchRatios r = plan_bench_ratios({a, b});
  EXPECT_EQ(r.n, 3U);
  EXPECT_DOUBLE_EQ(r.median, 1.0);
  EXPECT_DOUBLE_EQ(r.least, 0.5);
  EXPECT_DOUBLE_EQ(r.most, 2.0);
  EXPECT_EQ(plan_bench_ratios({}).n, 0U);
}

}  // namespace
}  // namespace scattermeter::apps
