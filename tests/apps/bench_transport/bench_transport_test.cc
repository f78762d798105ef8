#include "apps/bench_transport/bench_transport.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(BenchTransport, AuditsEveryRow) {
  TransportBenchOptions options;
  options.seconds = 0.01;

  const std::vector<TransportBenchRow> rows = bench_transport(options);
  ASSERT_EQ(rows.size(), 30U);
  EXPECT_EQ(rows.front().triangles, 12);
  EXPECT_EQ(rows[21].triangles, 786432);
  EXPECT_EQ(rows.back().triangles, 327680);
  for (const TransportBenchRow& row : rows) {
    EXPECT_LT(std::abs(row.audit_error), 1e-9);
    // Of round bodies one path in some ten thousand is lost to rounding.
    EXPECT_LE(row.lost_paths, row.body == "cube" ? 0 : 2);
    EXPECT_GT(row.scatterings_per_s, 0.0);
    // Between 0.952 and 0.967 with long runs.
    EXPECT_NEAR(row.escaped, 0.96, 0.03);
  }
  EXPECT_THAT(transport_bench_csv(rows), HasSubstr("cube,786432,rays,"));
}

}  // namespace
}  // namespace scattermeter::apps
