#include "calib/led/cell_mean.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/dense_solve.h"
#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

constexpr double kSpotStds = 5.0;

// A mean, and the linear trend of the signal about it.
struct CellTrend {
  CellMean mean;
  Eigen::Vector2d slope_counts_per_mm;
  double variance_counts2;  // of one sample, on average

  double residual(const PlaneSample& s) const {
    return s.signal_counts - mean.signal_counts -
           slope_counts_per_mm.dot(
               Eigen::Vector2d(s.x_mm - mean.position_mm.x(), s.y_mm - mean.position_mm.y()));
  }
};

std::optional<CellTrend> trend_of(const std::vector<PlaneSample>& samples,
                                  const std::vector<bool>& kept, double max_left_out) {
  double n = 0.0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double variance = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!kept[i]) continue;
    n += 1.0;
    sum += Eigen::Vector3d(samples[i].x_mm, samples[i].y_mm, samples[i].signal_counts);
    variance += samples[i].variance_counts2;
  }
  if (n < kLeastCellSamples || n < (1.0 - max_left_out) * static_cast<double>(samples.size())) {
    return std::nullopt;
  }
  sum /= n;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d slope_sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!kept[i]) continue;
    const Eigen::Vector2d d(samples[i].x_mm - sum.x(), samples[i].y_mm - sum.y());
    spread += d * d.transpose() / n;
    slope_sum += d * ((samples[i].signal_counts - sum.z()) / n);
  }
  const Eigen::Vector2d slope = SymmetricSolver(spread).solve(slope_sum);
  if (!slope.allFinite()) return std::nullopt;
  const auto spots = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), false));
  // Unweighted: the variance of a sample follows its noise, so weights derived from it bias the
  // mean.
  return CellTrend{
      {sum.head<2>(), spread, sum.z(), variance / (n * n), spots}, slope, variance / n};
}

}  // namespace

std::optional<CellMean> robust_cell_mean(const std::vector<PlaneSample>& samples,
                                         double max_left_out) {
  std::vector<bool> kept(samples.size(), true);
  CellMean mean{};
  for (int round = 0; round < 5; ++round) {
    const std::optional<CellTrend> trend = trend_of(samples, kept, max_left_out);
    if (!trend) return std::nullopt;
    mean = trend->mean;
    std::vector<double> residuals;
    for (const PlaneSample& s : samples) residuals.push_back(trend->residual(s));
    const double limit =
        kSpotStds * std::max(std::sqrt(trend->variance_counts2),
                             kStdPerMad * median_absolute_deviation(residuals, 0.0));
    bool changed = false;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const bool keep = std::abs(residuals[i]) <= limit;
      changed = changed || keep != kept[i];
      kept[i] = keep;
    }
    if (!changed) break;
  }
  return mean;
}

}  // namespace scattermeter::calib
