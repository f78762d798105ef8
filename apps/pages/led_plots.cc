#include "apps/pages/led_plots.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

constexpr double kOutermost = 0.02;  // share of the cells beyond the scale

// The value rounded up to 1, 2 or 5 times a power of ten.
double round_scale(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * unit * (1.0 + 1e-9)) return step * unit;
  }
  return 10.0 * unit;
}

double scale_of(std::vector<double> values, double least) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  if (values.empty()) return least;
  for (double& v : values) v = std::abs(v);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(
                                       (1.0 - kOutermost) * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return round_scale(std::max(least, *at));
}

Plot map_plot(const calib::LedPlaneMap& map, const std::vector<double>& values,
              const std::string& title, const PlotColours& colours) {
  PlotSeries cells{"", PlotSeries::Style::kCells, {}, {}};
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column) {
      cells.x.push_back(column + 0.5);
      cells.y.push_back(row + 0.5);
    }
  }
  cells.dx.assign(values.size(), 1.0);
  cells.dy.assign(values.size(), 1.0);
  cells.value = values;
  Plot plot;
  plot.title = title;
  plot.x = {"cell along x_axis", false, 0.0, static_cast<double>(map.columns)};
  plot.y = {"cell along y_axis", false, 0.0, static_cast<double>(map.rows)};
  plot.series = {cells};
  plot.colours = colours;
  return plot;
}

}  // namespace

std::vector<PagePlot> led_plane_plots(const std::vector<calib::LedCheck>& leds) {
  std::vector<double> percents, stds;
  const auto in_stds = [](const calib::LedPlaneMap& map) {
    std::vector<double> out;
    for (std::size_t i = 0; i < map.percent.size(); ++i) {
      out.push_back(map.percent[i] / map.std_percent[i]);
    }
    return out;
  };
  for (const calib::LedCheck& led : leds) {
    for (const calib::LedPlaneMap& map : led.maps) {
      percents.insert(percents.end(), map.percent.begin(), map.percent.end());
      const std::vector<double> own = in_stds(map);
      stds.insert(stds.end(), own.begin(), own.end());
    }
  }
  const PlotColours percent_scale{"measured over predicted minus 1 [%]", scale_of(percents, 0.1)};
  const PlotColours std_scale{"of its standard deviation", scale_of(stds, 3.0)};
  std::vector<PagePlot> out, over_noise;
  for (const calib::LedCheck& led : leds) {
    for (const calib::LedPlaneMap& map : led.maps) {
      const std::vector<double> deviations = in_stds(map);
      double squares = 0, std_squares = 0, worst = 0, n = 0;
      for (std::size_t i = 0; i < deviations.size(); ++i) {
        if (!std::isfinite(deviations[i])) continue;
        squares += map.percent[i] * map.percent[i];
        std_squares += deviations[i] * deviations[i];
        worst = std::max(worst, std::abs(map.percent[i]));
        n += 1.0;
      }
      if (n == 0.0) continue;
      // The explanation is given only once.
      const std::string what =
          out.empty()
              ? " Measured light on the plane over that predicted for the LED of the rig, mean of "
                "the channels, each over its median. A slope indicates another position or "
                "direction of the LED, a bowl another distance or lobe or light besides the LED, a "
                "spot dust or a shadow. Grey: no usable cell."
              : "";
      const std::string noise =
          out.empty() ? " In units of the noise of the samples: rms 1 without other errors." : "";
      const std::string name = fmt::format("{} under {}", map.file, led.light);
      out.push_back({map_plot(map, map.percent, name, percent_scale),
                     fmt::format("{}: rms {:.3g} %, worst {:.3g} %.{}", name,
                                 std::sqrt(squares / n), worst, what)});
      over_noise.push_back({map_plot(map, deviations, name, std_scale),
                            fmt::format("{}, over its standard deviation: rms {:.3g}.{}", name,
                                        std::sqrt(std_squares / n), noise)});
    }
  }
  out.insert(out.end(), over_noise.begin(), over_noise.end());
  return out;
}

}  // namespace scattermeter::apps
