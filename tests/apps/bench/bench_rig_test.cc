#include "apps/bench/bench_rig.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(BenchRig, TwoDraws) {
  RigBenchOptions options;
  options.draws = 2;
  options.image_width_px = 320;

  const RigBench bench = bench_rig(options);
  ASSERT_EQ(bench.rows.size(), 9U);
  EXPECT_EQ(bench.singles.size(), 2U * 12U * 3U);
  for (const RigBenchRow& row : bench.rows) {
    const EstimateStatistics& s = row.sigma_s_prime_per_mm.joint;
    if (s.n == 0) continue;  // refused
    EXPECT_LT(std::abs(s.bias_relative), 0.2) << row.material << row.channel;
    // The rig owns up to more than the noise.
    EXPECT_GT(s.predicted_std, 0.0);
  }
  const std::string csv = single_shot_csv(bench);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 72);
  EXPECT_THAT(rig_bench_table(bench), HasSubstr("single shots vary by"));
  options.draws = 1;
  EXPECT_THROW(bench_rig(options), std::invalid_argument);
  options.draws = 2;
  options.point_std_px = -1.0;
  EXPECT_THROW(bench_rig(options), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
