#include "core/fit/estimate.h"

#include <limits>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

Estimate with(const Quantity& s, const Quantity& a) {
  Estimate e;
  e.sigma_s_prime_per_mm = s;
  e.sigma_a_per_mm = a;
  return e;
}

std::vector<std::string> reasons_of(const Quantity& s, const Quantity& a) {
  Estimate e = with(s, a);
  refuse_undetermined(e);
  return e.reasons;
}

TEST(FitEstimate, AnIntervalThatReachesZeroIsALimitIfTheDeviationIsLarge) {
  EXPECT_FALSE(is_upper_limit({1.0, 0.5, 0.0, 2.0}));  // half the value is still a value
  EXPECT_TRUE(is_upper_limit({1.0, 0.51, 0.0, 2.0}));
  EXPECT_FALSE(is_upper_limit({1.0, 0.51, 0.1, 2.0}));
  EXPECT_TRUE(is_upper_limit({0.0, 0.1, 0.0, 0.2}));
  EXPECT_FALSE(is_upper_limit({0.0, 0.0, 0.0, 0.0}));
  EXPECT_FALSE(is_upper_limit({1.0, kUnknown, 0.0, kUnknown}));
  EXPECT_FALSE(is_upper_limit({1.0, 0.6, 0.0, kUnknown}));
}

TEST(FitEstimate, AnUpperLimitOfAbsorptionIsNoReasonToRefuse) {
  EXPECT_TRUE(reasons_of({1.0, 0.1, 0.8, 1.2}, {1e-3, 9e-4, 0.0, 3e-3}).empty());
  EXPECT_TRUE(reasons_of({1.0, 0.1, 0.8, 1.2}, {1e-3, 4e-4, 2e-4, 2e-3}).empty());
}

TEST(FitEstimate, UndeterminedCoefficientsAreRefusedWithTheirReason) {
  EXPECT_EQ(reasons_of({1.0, 0.1, 0.8, 1.2}, {1e-3, 6e-4, 1e-4, 3e-3}),
            std::vector<std::string>{"these shots do not determine sigma_a: 0.001 +- 0.0006 per mm "
                                     "(expose longer, or add shots under another LED)"});
  EXPECT_EQ(reasons_of({1.0, 0.6, 0.0, 2.5}, {1e-3, 1e-4, 8e-4, 1e-2}),
            std::vector<std::string>{"these shots do not determine sigma_s': it is below 2.5 per "
                                     "mm, and may be 0 (use more light, or a smaller piece)"});
  EXPECT_EQ(reasons_of({1.0, 0.6, 0.1, 2.5}, {1e-3, 1e-4, 8e-4, 1e-2}).size(), 1U);
  EXPECT_EQ(reasons_of({1.0, 0.1, 0.8, 1.2}, {1e-3, 1e-4, 8e-4, kUnknown}),
            std::vector<std::string>{"these shots set no upper limit to a coefficient"});
}

TEST(FitEstimate, AnIndependentErrorAddsToVarianceIntervalAndBudget) {
  Estimate e = with({1.0, 0.03, 0.9, 1.2}, {1e-2, 4e-3, 1e-3, 2e-2});
  e.correlation = 0.5;
  widen({"cause", 0.04, 3e-3}, -0.04 * 3e-3, e);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.std, 0.05, 1e-12);
  EXPECT_NEAR(e.sigma_a_per_mm.std, 5e-3, 1e-12);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.low95, 1.0 - 0.1 * 5.0 / 3.0, 1e-12);
  EXPECT_NEAR(e.sigma_s_prime_per_mm.high95, 1.0 + 0.2 * 5.0 / 3.0, 1e-12);
  EXPECT_NEAR(e.correlation * 0.05 * 5e-3, 0.5 * 0.03 * 4e-3 - 0.04 * 3e-3, 1e-12);
  ASSERT_EQ(e.budget.size(), 1U);
  EXPECT_EQ(e.budget[0].cause, "cause");
}

TEST(FitEstimate, AReasonIsGivenOnce) {
  Estimate e = with({1.0, 0.6, 0.1, 2.5}, {1e-3, 6e-4, 1e-4, 3e-3});
  refuse_undetermined(e);
  refuse_undetermined(e);
  EXPECT_EQ(e.reasons.size(), 2U);
}

TEST(Estimate, IsNearByTheOthersDeviations) {
  Estimate a, b;
  a.sigma_s_prime_per_mm = normal_quantity(1.00, 1.0);
  b.sigma_s_prime_per_mm = normal_quantity(1.01, 0.2);
  a.sigma_a_per_mm = b.sigma_a_per_mm = normal_quantity(0.1, 0.0);
  EXPECT_TRUE(is_near(a, b, 0.051));
  EXPECT_FALSE(is_near(a, b, 0.049));
  a.sigma_a_per_mm.value = 0.11;
  EXPECT_FALSE(is_near(a, b, 0.051));
}

}  // namespace
}  // namespace scattermeter
