#include "apps/pages/budget_details.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(BudgetDetails, TheLargestCauseComesFirst) {
  Estimate e;
  EXPECT_EQ(budget_details('R', e).markup, "");
  e.converged = true;
  e.sigma_s_prime_per_mm = normal_quantity(1.0, 0.05);
  e.sigma_a_per_mm = normal_quantity(0.01, 0.001);
  e.budget = {{"noise", 0.03, 0.0001}, {"scale", 0.04, 0.0001}, {"eta", 0.0, 0.0009}};
  const std::string page = budget_details('R', e).markup;
  EXPECT_THAT(page, testing::HasSubstr("R: the uncertainty of sigma_s&#39; is mainly due to "
                                       "scale (64 %), that of sigma_a to eta (81 %)"));
  EXPECT_LT(page.find(">eta<"), page.find(">scale<"));
  EXPECT_LT(page.find(">scale<"), page.find(">noise<"));
  EXPECT_THAT(page, testing::HasSubstr("value=\"0.3600\">36 %<"));
}

}  // namespace
}  // namespace scattermeter::apps
