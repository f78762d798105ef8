#include "apps/bench/bench_sums.h"

#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using testing::HasSubstr;
using testing::Not;

// Figures, not times: errors are below what is certified, that below the tolerance; every patch
// count has its row; all fits of the peers find the material as well as they can.
TEST(BenchSums, ErrorsAreBelowTheTolerance) {
  SumsBenchOptions options;
  options.patches = {500, 2000};
  options.rows = {300};
  options.tolerances = {1e-2, 1e-4};
  options.loose_tolerance = 0.0;
  options.peer_patches = 400;
  options.repeats = 1;
  const SumsBench bench = bench_sums(options);
  ASSERT_EQ(bench.rows.size(), 8U);
  for (const SumsBenchRow& r : bench.rows) {
    EXPECT_LE(r.certified_error, r.tolerance + 1e-5);
    EXPECT_LE(r.worst_error[0], r.certified_error);
    EXPECT_LE(r.median_error, r.worst_error[0]);
    // Relative to absolute terms; the certificate counts their parts, which are larger.
    EXPECT_LE(r.worst_error[1], 5.0 * r.certified_error);
    EXPECT_LE(r.worst_error[2], 5.0 * r.certified_error);
    EXPECT_LE(r.pairs_per_row, r.patches);
  }
  EXPECT_TRUE(std::isfinite(patches_exponent(bench, "cube", 300, 1e-4)));
  EXPECT_TRUE(std::isnan(patches_exponent(bench, "cube", 301, 1e-4)));
  ASSERT_EQ(bench.peers.size(), 3U);
  EXPECT_LT(std::abs(bench.peers[0].error_sigma_s_prime), 1e-4);
  EXPECT_LT(std::abs(bench.peers[0].error_sigma_a), 1e-3);
  EXPECT_THAT(sums_bench_table(bench), HasSubstr("patches^"));
  EXPECT_THAT(sums_bench_csv(bench), HasSubstr("sphere,1,2000,300,"));
  EXPECT_THAT(sums_peer_csv(bench), HasSubstr("chunked"));
  EXPECT_EQ(sums_patches_plot(bench).series.size(), 4U);
  EXPECT_EQ(sums_error_plot(bench).series.size(), 4U);
}

// Of what was measured to be within 1e-4, the fastest: not what is faster still and off by more.
TEST(BenchSums, TellsTheFastestWithinTheMeasuredError) {
  SumsBenchRow row;
  row.body = "cube";
  row.patches = 1000;
  row.rows = 300;
  row.direct_ns = 1000.0;
  const auto measured = [&row](double tolerance, double sum_s, double error_by_sigma_a) {
    row.tolerance = tolerance;
    row.sum_s = sum_s;
    row.worst_error[2] = error_by_sigma_a;
    return row;
  };
  SumsBench bench;
  bench.rows = {measured(1e-4, 0.03, 1e-7), measured(5e-3, 0.02, 0.9e-4),
                measured(1e-2, 0.01, 1.1e-4)};
  EXPECT_THAT(sums_bench_table(bench),
              HasSubstr("measured at tolerance 5e-03, 0 times faster than the direct sum's 0.300 s "
                        "on one thread; all threads 15 times, with the tree at hand 15 times"));
  bench.rows.resize(1);
  EXPECT_THAT(sums_bench_table(bench), HasSubstr("measured at tolerance 1e-04, "));
  bench.rows = {measured(1e-2, 0.01, 1.1e-4)};
  EXPECT_THAT(sums_bench_table(bench), Not(HasSubstr("measured at tolerance ")));
}

TEST(BenchSums, RefusesWhatMakesNoSense) {
  SumsBenchOptions options;
  options.patches = {1};
  EXPECT_THROW(bench_sums(options), std::invalid_argument);
  options.patches = {1000};
  options.tolerances = {1e-9};
  EXPECT_THROW(bench_sums(options), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
