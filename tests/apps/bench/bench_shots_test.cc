#include "apps/bench/bench_shots.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using testing::HasSubstr;

// More shots, no other truth, and a smaller error of it.
TEST(BenchShots, AnswersStayRight) {
  ShotsBenchOptions options;
  options.shots = {1, 4};
  options.image_width_px = 240;
  options.repeats = 1;

  const std::vector<ShotsBenchRow> rows = bench_shots(options);
  ASSERT_EQ(rows.size(), 2U);
  for (const ShotsBenchRow& r : rows) {
    EXPECT_GT(r.seconds, 0.0);
    EXPECT_LT(r.error_sigma_s_prime, 4.0 * r.std_sigma_s_prime);
    EXPECT_LT(r.error_sigma_a, 4.0 * r.std_sigma_a);
    EXPECT_LT(r.error_sigma_s_prime, 0.02);
  }
  EXPECT_LT(rows[1].std_sigma_a, rows[0].std_sigma_a);
  EXPECT_THAT(shots_bench_table(rows), HasSubstr("shots^"));
  EXPECT_THAT(shots_bench_csv(rows), HasSubstr("fit"));
  options.shots = {0};
  EXPECT_THROW(bench_shots(options), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
