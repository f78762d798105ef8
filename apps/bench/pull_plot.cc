#include "apps/bench/pull_plot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scattermeter::apps {
namespace {

constexpr double kEnd = 5.0;
constexpr double kBin = 0.5;
constexpr int kBins = static_cast<int>(2.0 * kEnd / kBin);

double standard_normal(double x) {
  return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi);
}

PlotSeries histogram(const std::string& name, const std::vector<double>& pulls) {
  std::vector<double> counts(kBins, 0.0);
  double total = 0.0;
  for (double pull : pulls) {
    if (std::isnan(pull)) continue;
    const double bin = std::clamp((pull + kEnd) / kBin, 0.0, kBins - 0.5);
    counts[static_cast<std::size_t>(bin)] += 1.0;
    total += 1.0;
  }
  PlotSeries series{name, PlotSeries::Style::kLineAndPoints, {}, {}, {}};
  for (int i = 0; total > 0.0 && i < kBins; ++i) {
    const double n = counts[static_cast<std::size_t>(i)];
    series.x.push_back(-kEnd + kBin * (i + 0.5));
    series.y.push_back(n / (total * kBin));
    series.y_std.push_back(std::sqrt(n) / (total * kBin));
  }
  return series;
}

}  // namespace

Plot pull_plot(const std::string& title,
               const std::vector<std::pair<std::string, std::vector<double>>>& pulls) {
  Plot plot;
  plot.title = title;
  plot.x = {"(estimate - truth) / standard deviation", false, -kEnd, kEnd};
  plot.y = {"density", false, 0.0};
  for (const auto& [name, values] : pulls) plot.series.push_back(histogram(name, values));
  PlotSeries normal{"standard normal", PlotSeries::Style::kLine, {}, {}, {}};
  for (double x = -kEnd; x <= kEnd; x += 0.05) {
    normal.x.push_back(x);
    normal.y.push_back(standard_normal(x));
  }
  plot.series.push_back(normal);
  return plot;
}

}  // namespace scattermeter::apps
