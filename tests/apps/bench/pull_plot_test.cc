#include "apps/bench/pull_plot.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(PullPlot, IsADensity) {
  const Plot plot = pull_plot("t", {{"a", {0.1, 0.2, -9.0, 9.0, std::nan("")}}});
  ASSERT_EQ(plot.series.size(), 2U);
  double sum = 0.0;
  for (double y : plot.series[0].y) sum += 0.5 * y;
  EXPECT_DOUBLE_EQ(sum, 1.0);
  EXPECT_DOUBLE_EQ(plot.series[0].y.front(), 0.5);  // a quarter over half a deviation
  EXPECT_DOUBLE_EQ(plot.series[0].y.back(), 0.5);
}

}  // namespace
}  // namespace scattermeter::apps
