#include "core/base/growth_exponent.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(GrowthExponent, OfAPower) {
  EXPECT_NEAR(growth_exponent({1, 10, 40}, {3, 3 * std::pow(10, 0.7), 3 * std::pow(40, 0.7)}), 0.7,
              1e-12);
  EXPECT_TRUE(std::isnan(growth_exponent({2, 2}, {1, 3})));
  EXPECT_TRUE(std::isnan(growth_exponent({}, {})));
  EXPECT_THROW(growth_exponent({1}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
