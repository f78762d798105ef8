#include "core/base/median.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(UpperMedian, IsTheUpperOfTwoInTheMiddle) {
  EXPECT_EQ(upper_median(std::vector<double>{3, 1, 2}), 2.0);
  EXPECT_EQ(upper_median(std::vector<int>{4, 1, 3, 2}), 3);
  EXPECT_EQ(upper_median(std::vector<float>{7}), 7.0F);
  EXPECT_THROW(upper_median(std::vector<double>{}), std::invalid_argument);
}

TEST(MedianAbsoluteDeviation, IsUnmovedByOneFarValue) {
  // Deviations from 3: 2, 1, 0, 1, 997.
  EXPECT_EQ(median_absolute_deviation(std::vector<double>{1, 2, 3, 4, 1000}, 3.0), 1.0);
  // From another centre: 1, 2, 3, 4, 1000.
  EXPECT_EQ(median_absolute_deviation(std::vector<double>{1, 2, 3, 4, 1000}, 0.0), 3.0);
  EXPECT_THROW(median_absolute_deviation(std::vector<double>{}, 0.0), std::invalid_argument);
}

// Half of a normal distribution lies within one median absolute deviation of its centre.
TEST(MedianAbsoluteDeviation, FactorIsThatOfTheNormalDistribution) {
  EXPECT_NEAR(std::erf(1.0 / kStdPerMad / std::numbers::sqrt2), 0.5, 1e-5);
}

}  // namespace
}  // namespace scattermeter
