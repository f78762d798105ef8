#include "apps/pages/led_map_plot.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr double kCell_deg = 4.0;
constexpr double kBlur_rad = 0.14;    // about half the distance of neighbouring positions
constexpr double kNearest_rad = 0.2;  // to a position with a value
constexpr double kWidest = 10.0;      // end of the colour scale, times the best value

double degrees(double rad) { return rad * 180.0 / std::numbers::pi; }

double value_of(const LedPosition& led, bool joined) { return joined ? led.joined : led.alone; }

// Geometric mean of the surrounding positions; NaN where the nearest of all has no value.
double smooth(const LedMap& map, const Eigen::Vector3d& direction, bool joined) {
  double sum = 0.0;
  double weights = 0.0;
  double nearest_rad = std::numeric_limits<double>::infinity();
  bool nearest_known = false;
  for (const LedPosition& led : map.positions) {
    const double cosine =
        std::clamp(direction.dot((led.position_mm - map.center_mm).normalized()), -1.0, 1.0);
    const double apart = std::acos(cosine);
    const double value = value_of(led, joined);
    if (apart < nearest_rad) {
      nearest_rad = apart;
      nearest_known = std::isfinite(value);
    }
    if (!std::isfinite(value)) continue;
    const double weight = std::exp(-apart * apart / (2.0 * kBlur_rad * kBlur_rad));
    sum += weight * std::log(value);
    weights += weight;
  }
  return nearest_known && nearest_rad < kNearest_rad ? std::exp(sum / weights) : kNoValue;
}

// Position on the map.
void add_position(const LedMap& map, const Eigen::Vector3d& at_mm, PlotSeries& series) {
  const Eigen::Vector3d d = (at_mm - map.center_mm).normalized();
  const double zenith = degrees(std::acos(std::clamp(d.z(), -1.0, 1.0)));
  if (zenith > 90.5) return;
  const double azimuth = std::atan2(d.y(), d.x());
  series.x.push_back(zenith * std::cos(azimuth));
  series.y.push_back(zenith * std::sin(azimuth));
}

}  // namespace

PagePlot led_map_plot(const SuggestedShots& shots, const LedMap& map, bool joined) {
  PlotSeries cells{"", PlotSeries::Style::kCells, {}, {}};
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  for (double x = -90.0 + 0.5 * kCell_deg; x < 90.0; x += kCell_deg) {
    for (double y = -90.0 + 0.5 * kCell_deg; y < 90.0; y += kCell_deg) {
      const double zenith = std::hypot(x, y) * std::numbers::pi / 180.0;
      if (zenith > 0.5 * std::numbers::pi) continue;
      const double azimuth = std::atan2(y, x);
      const double value = 100.0 * smooth(map,
                                          {std::sin(zenith) * std::cos(azimuth),
                                           std::sin(zenith) * std::sin(azimuth), std::cos(zenith)},
                                          joined);
      if (!std::isfinite(value)) continue;
      cells.x.push_back(x);
      cells.y.push_back(y);
      cells.dx.push_back(1.02 * kCell_deg);
      cells.dy.push_back(1.02 * kCell_deg);
      cells.value.push_back(value);
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  if (cells.value.empty()) least = most = 1.0;  // nothing to colour
  PlotSeries horizon{"", PlotSeries::Style::kDashedLine, {}, {}, {}, 6};
  for (int k = 0; k <= 72; ++k) {
    horizon.x.push_back(90.0 * std::cos(k * std::numbers::pi / 36.0));
    horizon.y.push_back(90.0 * std::sin(k * std::numbers::pi / 36.0));
  }
  PlotSeries planned{"LEDs planned", PlotSeries::Style::kPoints, {}, {}, {}, 6};
  for (const Eigen::Vector3d& at : map.planned_mm) add_position(map, at, planned);
  PlotSeries camera{"camera", PlotSeries::Style::kPoints, {}, {}, {}, 4};
  add_position(map, map.camera_mm, camera);
  PlotSeries best{"best", PlotSeries::Style::kPoints, {}, {}, {}, 1};
  const LedPosition* best_led = nullptr;
  for (const LedPosition& led : map.positions) {
    const double value = value_of(led, joined);
    if (std::isfinite(value) && (best_led == nullptr || value < value_of(*best_led, joined))) {
      best_led = &led;
    }
  }
  if (best_led != nullptr) add_position(map, best_led->position_mm, best);

  PagePlot out;
  out.plot.title = fmt::format(
      "{} {}, {}: {}", shots.material, shots.channel, map.object,
      joined ? "the planned shots and one more, its LED here" : "one shot, its LED here");
  out.plot.x = {"degrees from the zenith towards +x", false, -95.0, 95.0};
  out.plot.y = {"towards +y", false, -95.0, 95.0};
  out.plot.series = {cells, horizon, planned, camera, best};
  out.plot.colours = {"deviation of sigma_a [%]",
                      std::max(1.001 * least, std::min(most, kWidest * least)), least, true};
  out.plot.equal_axes = true;
  out.plot.legend_above = true;
  out.plot.width_px = 760;
  out.plot.height_px = 680;
  out.caption = fmt::format(
      "{} {}, {}: predicted standard deviation of sigma_a, LED at {:.0f} mm from the centre of the "
      "object, {}.",
      shots.material, shots.channel, map.object, map.distance_mm,
      joined ? "one more shot besides the planned ones" : "a single shot");
  if (best_led != nullptr) {
    const Eigen::Vector3d& at = best_led->position_mm;
    out.caption += fmt::format(" Best: {:.2g} % with the LED at ({:.0f}, {:.0f}, {:.0f}) mm",
                               100.0 * value_of(*best_led, joined), at.x(), at.y(), at.z());
    out.caption += joined ? fmt::format("; {:.2g} % without.", 100.0 * shots.planned) : ".";
  }
  return out;
}

}  // namespace scattermeter::apps
