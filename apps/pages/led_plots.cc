#include "apps/pages/led_plots.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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

// A map and the LED whose light it shows.
struct NamedMap {
  std::string light;
  calib::LedPlaneMap map;
};

std::vector<PagePlot> map_plots(const std::vector<NamedMap>& maps, const std::string& what) {
  std::vector<double> percents, stds;
  const auto in_stds = [](const calib::LedPlaneMap& map) {
    std::vector<double> out;
    for (std::size_t i = 0; i < map.percent.size(); ++i) {
      out.push_back(map.percent[i] / map.std_percent[i]);
    }
    return out;
  };
  for (const auto& [light, map] : maps) {
    percents.insert(percents.end(), map.percent.begin(), map.percent.end());
    const std::vector<double> own = in_stds(map);
    stds.insert(stds.end(), own.begin(), own.end());
  }
  const PlotColours percent_scale{"measured over predicted minus 1 [%]", scale_of(percents, 0.1)};
  const PlotColours std_scale{"of its standard deviation", scale_of(stds, 3.0)};
  std::vector<PagePlot> out, over_noise;
  for (const auto& [light, map] : maps) {
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
    const std::string explained = out.empty() ? " " + what : "";
    const std::string noise =
        out.empty() ? " In units of the noise of the samples: rms 1 without other errors." : "";
    const std::string name = fmt::format("{} under {}", map.file, light);
    out.push_back({map_plot(map, map.percent, name, percent_scale),
                   fmt::format("{}: rms {:.3g} %, worst {:.3g} %.{}", name, std::sqrt(squares / n),
                               worst, explained)});
    over_noise.push_back({map_plot(map, deviations, name, std_scale),
                          fmt::format("{}, over its standard deviation: rms {:.3g}.{}", name,
                                      std::sqrt(std_squares / n), noise)});
  }
  out.insert(out.end(), over_noise.begin(), over_noise.end());
  return out;
}

PagePlot highlight_plot(const calib::LedCalibration& c) {
  PlotSeries used{"used", PlotSeries::Style::kPoints, {}, {}};
  PlotSeries left_out{"left out", PlotSeries::Style::kOpenPoints, {}, {}};
  for (std::size_t i = 0; i < c.fit.highlight_used.size(); ++i) {
    PlotSeries& series = c.fit.highlight_used[i] ? used : left_out;
    series.x.push_back(c.fit.highlight_residuals_px[i].x());
    series.y.push_back(c.fit.highlight_residuals_px[i].y());
  }
  Plot plot;
  plot.title = "Highlights of the spheres";
  plot.x.label = "predicted - measured, to the right [px]";
  plot.y.label = "down [px]";
  plot.y_down = plot.equal_axes = true;
  double most_px = 0.0;
  for (const PlotSeries* series : {&used, &left_out}) {
    for (const double v : series->x) most_px = std::max(most_px, std::abs(v));
    for (const double v : series->y) most_px = std::max(most_px, std::abs(v));
  }
  if (std::isfinite(most_px) && most_px > 0.0) {
    for (PlotAxis* axis : {&plot.x, &plot.y}) {
      axis->max = round_scale(1.05 * most_px);
      axis->min = -*axis->max;
    }
  }
  plot.series = {used, left_out};
  return {plot, fmt::format("Where the fitted LED appears in each mirror sphere, against where it "
                            "was seen: rms {:.3f} px, worst {:.3f} px.",
                            c.fit.highlight_rms_px, c.fit.highlight_worst_px)};
}

// The light of the lobe as each cell shows it, mean of the channels, and the difference to the
// fitted one.
std::vector<PagePlot> lobe_plots(const calib::LedCalibration& c) {
  std::vector<PlotSeries> measured, difference;
  std::vector<std::pair<double, double>> lobe_at;  // at the angles of the cells
  for (const calib::LedPlaneGrid& grid : c.shots.grids) {
    const calib::LedPlaneMap map =
        calib::plane_map(grid, c.shots.scene.cells, c.fit.cell_residuals);
    PlotSeries light{grid.file, PlotSeries::Style::kPoints, {}, {}};
    PlotSeries off = light;
    std::vector<bool> told(map.percent.size(), false);
    for (const calib::ShadedCell& cell : c.shots.scene.cells) {
      const auto i = static_cast<std::size_t>(cell.row * grid.columns + cell.column);
      if (cell.shot != grid.shot || told[i] || !std::isfinite(map.percent[i])) continue;
      told[i] = true;
      const Eigen::Vector3d toward =
          (c.shots.scene.cell_mm(cell) - c.fit.led.position_mm).normalized();
      const double angle_deg =
          std::acos(std::clamp(toward.dot(c.fit.led.axis), -1.0, 1.0)) * 180.0 / std::numbers::pi;
      const double lobe = 100.0 * c.fit.led.lobe(toward);
      light.x.push_back(angle_deg);
      light.y.push_back(lobe * (1.0 + 0.01 * map.percent[i]));
      light.y_std.push_back(0.01 * lobe * map.std_percent[i]);
      off.x.push_back(angle_deg);
      off.y.push_back(map.percent[i]);
      off.y_std.push_back(map.std_percent[i]);
      lobe_at.emplace_back(angle_deg, lobe);
    }
    measured.push_back(light);
    difference.push_back(off);
  }
  // A lobe that is not round has several values at an angle.
  const bool is_round = !c.fit.led.table || c.fit.led.table->is_round();
  PlotSeries fitted{
      "fitted", is_round ? PlotSeries::Style::kLine : PlotSeries::Style::kOpenPoints, {}, {}};
  std::sort(lobe_at.begin(), lobe_at.end());
  for (const auto& [angle_deg, value] : lobe_at) {
    fitted.x.push_back(angle_deg);
    fitted.y.push_back(value);
  }
  measured.push_back(fitted);
  for (std::size_t i = 0; i < measured.size(); ++i) measured[i].look = i % 8;
  Plot lobe;
  lobe.title = "Light along the lobe";
  lobe.x.label = "angle from the axis [degrees]";
  lobe.y.label = "of the intensity on the axis [%]";
  lobe.series = measured;
  Plot off;
  off.title = "Light along the lobe, measured over fitted";
  off.x.label = lobe.x.label;
  off.y.label = "measured over fitted minus 1 [%]";
  off.series = difference;
  return {{lobe,
           "Radiant intensity that the cells of the white planes show, mean of the channels, "
           "and the fitted one. The lobe is known only as far out as there are points."},
          {off,
           "Their difference, with the standard deviation of the samples' noise. A bend is a "
           "lobe of another shape than the fitted one; a spread, dust or a shadow."}};
}

}  // namespace

std::vector<PagePlot> led_plane_plots(const std::vector<calib::LedCheck>& leds) {
  std::vector<NamedMap> maps;
  for (const calib::LedCheck& led : leds) {
    for (const calib::LedPlaneMap& map : led.maps) maps.push_back({led.light, map});
  }
  return map_plots(
      maps,
      "Measured light on the plane over that predicted for the LED of the rig, mean of "
      "the channels, each over its median. A slope indicates another position or "
      "direction of the LED, a bowl another distance or lobe or light besides the LED, a "
      "spot dust or a shadow. Grey: no usable cell.");
}

std::vector<PagePlot> led_fit_plots(const calib::LedCalibration& c) {
  std::vector<PagePlot> out;
  if (!c.fit.highlight_used.empty()) out.push_back(highlight_plot(c));
  if (c.fit.cell_used.empty()) return out;
  for (PagePlot& plot : lobe_plots(c)) out.push_back(std::move(plot));
  std::vector<NamedMap> maps;
  for (const calib::LedPlaneGrid& grid : c.shots.grids) {
    maps.push_back({c.light, calib::plane_map(grid, c.shots.scene.cells, c.fit.cell_residuals)});
  }
  for (PagePlot& plot :
       map_plots(maps,
                 "Measured light on the plane over that of the fitted LED, mean of the channels. "
                 "What is not even is not explained by one LED of this lobe: a spot is dust or a "
                 "shadow; a slope or a bowl is other light or a plane in another position. Grey: "
                 "no usable cell.")) {
    out.push_back(std::move(plot));
  }
  return out;
}

}  // namespace scattermeter::apps
