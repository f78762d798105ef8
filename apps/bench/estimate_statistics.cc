#include "apps/bench/estimate_statistics.h"

#include <cmath>
#include <limits>

namespace scattermeter::apps {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double ratio(double a, double b) { return b != 0.0 ? a / b : kNone; }

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (double v : values) sum += v;
  return ratio(sum, static_cast<double>(values.size()));
}

}  // namespace

double sampled_std(const std::vector<double>& values) {
  if (values.size() < 2) return kNone;
  const double mean = mean_of(values);
  double sum = 0.0;
  for (double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double coefficient_of_variation(const std::vector<double>& values) {
  return ratio(sampled_std(values), mean_of(values));
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (double v : values) sum += v * v;
  return std::sqrt(ratio(sum, static_cast<double>(values.size())));
}

NoiseStd noise_std(const Estimate& estimate) {
  for (const BudgetLine& line : estimate.budget) {
    if (line.cause == "noise") return {line.std_sigma_s_prime_per_mm, line.std_sigma_a_per_mm};
  }
  return {kNone, kNone};
}

EstimateStatistics estimate_statistics(double truth, const std::vector<DrawnEstimate>& estimates) {
  EstimateStatistics s;
  s.n = estimates.size();
  s.truth = truth;
  std::vector<double> values, errors, stds, noise;
  double held = 0.0;
  for (const DrawnEstimate& a : estimates) {
    const Quantity& q = a.quantity;
    values.push_back(q.value);
    errors.push_back(q.value - truth);
    stds.push_back(q.std);
    noise.push_back(a.noise_std);
    s.pulls.push_back(ratio(q.value - truth, q.std));
    if (q.low95 <= truth && truth <= q.high95) held += 1.0;
  }
  const auto n = static_cast<double>(s.n);
  s.mean = mean_of(values);
  s.bias_relative = ratio(s.mean - truth, truth);
  s.sampled_std = sampled_std(values);
  s.bias_relative_std = ratio(s.sampled_std, truth * std::sqrt(n));
  s.predicted_std = root_mean_square(stds);
  s.std_ratio = ratio(s.sampled_std, s.predicted_std);
  s.rmse = root_mean_square(errors);
  s.rmse_over_noise_std = ratio(s.rmse, root_mean_square(noise));
  s.coverage95 = ratio(held, n);
  return s;
}

}  // namespace scattermeter::apps
