#include "apps/pages/page_number.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(PageNumber, KeepsSixDigits) {
  EXPECT_EQ(page_number(0.0), 0.0);
  EXPECT_FALSE(std::signbit(page_number(-0.0)));
  EXPECT_EQ(page_number(1.23456789), 1.23457);
  EXPECT_EQ(page_number(-9.87654321e-12), -9.87654e-12);
  EXPECT_EQ(page_number(4.0e300), 4.0e300);
  EXPECT_EQ(page_number(1.23e-310), 1.23e-310);
  EXPECT_EQ(page_number(5e-324), 5e-324);
}

}  // namespace
}  // namespace scattermeter::apps
