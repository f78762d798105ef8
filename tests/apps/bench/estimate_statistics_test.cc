#include "apps/bench/estimate_statistics.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(EstimateStatistics, ByHand) {
  // Truth 10; answers 9 and 13, each with its deviation and interval.
  const EstimateStatistics s =
      estimate_statistics(10.0, {{{9.0, 1.0, 7.04, 10.96}, 0.5}, {{13.0, 1.0, 11.04, 14.96}, 0.5}});
  EXPECT_EQ(s.n, 2U);
  EXPECT_DOUBLE_EQ(s.mean, 11.0);
  EXPECT_DOUBLE_EQ(s.bias_relative, 0.1);
  EXPECT_DOUBLE_EQ(s.sampled_std, std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(s.bias_relative_std, 0.2);  // sqrt(8) / sqrt(2) / 10
  EXPECT_DOUBLE_EQ(s.predicted_std, 1.0);
  EXPECT_DOUBLE_EQ(s.std_ratio, std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(5.0));
  EXPECT_DOUBLE_EQ(s.rmse_over_noise_std, std::sqrt(5.0) / 0.5);
  EXPECT_DOUBLE_EQ(s.coverage95, 0.5);
  EXPECT_EQ(s.pulls, (std::vector<double>{-1.0, 3.0}));
  EXPECT_TRUE(std::isnan(estimate_statistics(1.0, {}).mean));
  EXPECT_TRUE(std::isnan(coefficient_of_variation({1.0})));
  EXPECT_DOUBLE_EQ(coefficient_of_variation({1.0, 3.0}), std::sqrt(2.0) / 2.0);
}

TEST(EstimateStatistics, NoiseLineOfTheBudget) {
  Estimate e;
  EXPECT_TRUE(std::isnan(noise_std(e).sigma_a_per_mm));
  e.budget = {{"scale", 1.0, 2.0}, {"noise", 3.0, 4.0}};
  EXPECT_EQ(noise_std(e).sigma_s_prime_per_mm, 3.0);
  EXPECT_EQ(noise_std(e).sigma_a_per_mm, 4.0);
}

}  // namespace
}  // namespace scattermeter::apps
