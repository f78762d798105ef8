#include "core/material/cosine_table.h"

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(CosineTable, IsLinearBetweenItsCosinesAndConstantBeyond) {
  const CosineTable square([](double c) { return c * c; });
  for (int k = 0; k < CosineTable::kSteps; ++k) {
    const double a = CosineTable::cosine(k);
    const double b = CosineTable::cosine(k + 1);
    EXPECT_EQ(square(a), a * a);
    EXPECT_NEAR(square(0.75 * a + 0.25 * b), 0.75 * a * a + 0.25 * b * b, 1e-15);
  }
  EXPECT_EQ(square(-0.5), 0.0);
  EXPECT_EQ(square(1.5), 1.0);
}

}  // namespace
}  // namespace scattermeter
