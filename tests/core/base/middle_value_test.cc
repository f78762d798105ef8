#include "core/base/middle_value.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(MiddleValue, IsTheUpperMedian) {
  EXPECT_EQ(middle_value(std::vector<double>{3, 1, 2}), 2.0);
  EXPECT_EQ(middle_value(std::vector<int>{4, 1, 3, 2}), 3);
  EXPECT_EQ(middle_value(std::vector<float>{7}), 7.0F);
  EXPECT_THROW(middle_value(std::vector<double>{}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
