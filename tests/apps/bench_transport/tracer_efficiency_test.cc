#include "apps/bench_transport/tracer_efficiency.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(TracerEfficiency, CountsWhatItTraces) {
  TracerEfficiencyOptions options;
  options.bodies = {"cube", "sphere"};
  options.sigma_s_prime_per_mm = {1.0};
  options.seconds = 0.05;
  options.image_width_px = 240;
  const std::vector<TracerEfficiencyRow> rows = tracer_efficiency(options);
  ASSERT_EQ(rows.size(), 2U);
  for (const TracerEfficiencyRow& r : rows) {
    EXPECT_GE(r.paths, 4 * 4096);
    EXPECT_GT(r.patches, 200);
    EXPECT_GT(r.scatterings_per_s, r.connections_per_s);
    EXPECT_GT(r.connections_per_s, 0.0);
    EXPECT_GT(r.variance_seconds, 0.0);
  }
  EXPECT_THAT(tracer_efficiency_table(rows), HasSubstr("sphere"));
  EXPECT_THAT(tracer_efficiency_csv(rows), HasSubstr("\nsphere,1,"));
}

}  // namespace
}  // namespace scattermeter::apps
