// Repeated estimates of a quantity compared with its true value.
#pragma once

#include <cstddef>
#include <vector>

#include "core/fit/estimate.h"

namespace scattermeter::apps {

// An estimate with the standard deviation from noise alone.
struct DrawnEstimate {
  Quantity quantity;
  double noise_std = 0;
};

struct EstimateStatistics {
  std::size_t n = 0;
  double truth = 0;
  double mean = 0;
  double bias_relative = 0;        // mean / truth - 1
  double bias_relative_std = 0;    // standard error of the same
  double sampled_std = 0;          // of the estimates about their mean (n - 1)
  double predicted_std = 0;        // root mean square of their own
  double std_ratio = 0;            // sampled over predicted: 1 where the prediction is right
  double rmse = 0;                 // about the truth
  double rmse_over_noise_std = 0;  // 1: at the bound set by the noise
  double coverage95 = 0;           // share of the 95 % intervals that contain the truth
  std::vector<double> pulls;       // (estimate - truth) / its standard deviation
};

// NaN where n (or n - 1, or a denominator) is zero.
EstimateStatistics estimate_statistics(double truth, const std::vector<DrawnEstimate>& estimates);

// Of the values about their mean (n - 1); NaN for fewer than two.
double sampled_std(const std::vector<double>& values);

// Standard deviation over mean of the values; NaN for fewer than two.
double coefficient_of_variation(const std::vector<double>& values);

// Root mean square; NaN for none.
double root_mean_square(const std::vector<double>& values);

// The line "noise" of the budget for both coefficients; NaN if there is none.
struct NoiseStd {
  double sigma_s_prime_per_mm = 0;
  double sigma_a_per_mm = 0;
};
NoiseStd noise_std(const Estimate& estimate);

}  // namespace scattermeter::apps
