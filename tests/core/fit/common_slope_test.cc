#include "core/fit/common_slope.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(CommonSlope, LevelsOfGroupsDoNotMatter) {
  const std::vector<double> x = {0, 1, 4, 5, 8, 9};
  std::vector<double> y;
  const std::vector<int> group = {0, 0, 1, 1, 2, 2};
  for (std::size_t i = 0; i < x.size(); ++i) y.push_back(-0.01 * x[i] + 7.0 * group[i]);
  const Departure d = common_slope(x, y, group);
  EXPECT_NEAR(d.value, -0.01, 1e-12);
  EXPECT_LT(d.std, 1e-7);
  EXPECT_TRUE(std::isinf(common_slope({1, 2}, {1, 2}, {0, 1}).std));
  EXPECT_THROW(common_slope({1}, {1, 2}, {0}), std::invalid_argument);
}

// One group, residuals about the line of slope 1 / 10 through the mean (2, 1): the textbook
// variance of a slope, sum of squares / (n - 2) / sum of (x - mean)^2.
TEST(CommonSlope, DeviationComesFromTheScatter) {
  const Departure d = common_slope({0, 1, 2, 3, 4}, {1, 0, 2, 1, 1}, {7, 7, 7, 7, 7});
  // sum dx dy = (-2)(0) + (-1)(-1) + 0 + 0 + 0 = 1; sum dx^2 = 10; sum dy^2 = 2.
  EXPECT_NEAR(d.value, 0.1, 1e-14);
  EXPECT_NEAR(d.std, std::sqrt((2.0 - 0.1) / 3.0 / 10.0), 1e-14);
}

}  // namespace
}  // namespace scattermeter
