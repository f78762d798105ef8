#include "apps/report/radiance_plots.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <fmt/core.h>

#include "core/camera/sensor_noise.h"

namespace scattermeter::apps {
namespace {

constexpr int kCurvePlaces = 100;

// Standard deviation of the logarithm of the response curve at these counts.
double curve_std(const capture::RadianceCalibration& calibration, double counts) {
  const std::vector<double>& knots = calibration.correction.response[0].knot_counts();
  const auto n = static_cast<Eigen::Index>(knots.size());
  const std::vector<double>& values = calibration.response_covariance[0];
  if (n == 0 || values.size() != static_cast<std::size_t>(n * n)) return 0.0;
  const Eigen::Map<const Eigen::MatrixXd> covariance(values.data(), n, n);
  const Eigen::RowVectorXd w = ResponseCurve::weights(knots, counts);
  return std::sqrt(std::max(0.0, w.dot(covariance * w.transpose())));
}

double brightest(const std::vector<capture::RadiancePoint>& points, const ResponseCurve& curve) {
  double top = curve.is_identity() ? 0.0 : curve.knot_counts().back();
  for (const capture::RadiancePoint& p : points) top = std::max(top, p.counts);
  return top;
}

PlotSeries points_of(const std::string& name, const std::vector<capture::RadiancePoint>& points,
                     double factor) {
  PlotSeries out{name, PlotSeries::Style::kPoints, {}, {}};
  for (const capture::RadiancePoint& p : points) {
    out.x.push_back(p.counts);
    out.y.push_back(factor * p.value);
    out.y_std.push_back(factor * p.std);
  }
  return out;
}

}  // namespace

Plot linearity_plot(const capture::RadianceCalibration& calibration) {
  const ResponseCurve& curve = calibration.correction.response[0];
  Plot plot{"Linearity", {"signal [counts]"}, {"recorded over linear minus 1 [%]"}, {}};
  PlotSeries flats = points_of("flats", calibration.linearity, 100.0);
  flats.look = 0;
  PlotSeries line{"curve", PlotSeries::Style::kLine, {}, {}};
  PlotSeries low{"+- 1 std", PlotSeries::Style::kDashedLine, {}, {}};
  line.look = low.look = 1;
  const double top = brightest(calibration.linearity, curve);
  for (int i = 0; i <= kCurvePlaces; ++i) {
    const double y = top * i / kCurvePlaces;
    line.x.push_back(y);
    line.y.push_back(100.0 * std::expm1(-curve.log_ratio_at(y)));
  }
  PlotSeries high = low;
  high.name.clear();
  low.x = high.x = line.x;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    const double std = 100.0 * curve_std(calibration, line.x[i]);
    low.y.push_back(line.y[i] - std);
    high.y.push_back(line.y[i] + std);
  }
  plot.legend_above = true;
  plot.series = {flats, line, low, high};
  return plot;
}

Plot photon_transfer_plot(const capture::RadianceCalibration& calibration, std::size_t colour) {
  const ResponseCurve& curve = calibration.correction.response.at(colour);
  const SensorNoise& noise = calibration.correction.noise.at(colour);
  Plot plot{fmt::format("Photon transfer, {}", kRgbName.at(colour)),
            {"signal [counts]", true},
            {"variance [counts^2]", true},
            {}};
  plot.legend_above = true;
  PlotSeries pairs = points_of("pairs of flats", calibration.noise.at(colour), 1.0);
  pairs.look = colour == 0 ? 1 : colour == 1 ? 2 : 0;
  PlotSeries model{"noise model", PlotSeries::Style::kLine, {}, {}};
  model.look = 6;
  const double top = brightest(calibration.noise.at(colour), curve);
  const double bottom =
      pairs.x.empty() ? 1e-3 * top : *std::min_element(pairs.x.begin(), pairs.x.end());
  for (int i = 0; top > 0.0 && i <= kCurvePlaces; ++i) {
    const double y = bottom * std::pow(top / bottom, static_cast<double>(i) / kCurvePlaces);
    // The noise model applies to linear counts.
    const double g = curve.gain_at(y);
    model.x.push_back(y);
    model.y.push_back((curve.light_counts(y) / noise.gain_e_per_count +
                       noise.read_noise_counts * noise.read_noise_counts) /
                      (g * g));
  }
  plot.series = {model, pairs};
  return plot;
}

}  // namespace scattermeter::apps
