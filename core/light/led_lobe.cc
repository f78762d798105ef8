#include "core/light/led_lobe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace scattermeter {
namespace {

constexpr double kHalfSpace_rad = 0.5 * std::numbers::pi;
constexpr double kRounding_rad = 1e-6;  // of an angle given in degrees

// Slope at the end of an interval of length h and slope `rise`, from this and the next one
// (Fritsch and Butland's three points), without turning against the interval.
double end_slope(double h, double rise, double next_h, double next_rise) {
  const double slope = ((2.0 * h + next_h) * rise - h * next_rise) / (h + next_h);
  if (!(slope * rise > 0.0)) return 0.0;
  return std::abs(slope) > 3.0 * std::abs(rise) ? 3.0 * rise : slope;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace

LobeTable::LobeTable(std::vector<double> angles_rad, std::vector<double> in_x,
                     std::vector<double> in_y, const Eigen::Vector3d& x_axis)
    : angles_rad_(std::move(angles_rad)), x_axis_(x_axis.normalized()) {
  const std::vector<double>& a = angles_rad_;
  require(a.size() >= 2, "expected at least two angles");
  require(std::adjacent_find(a.begin(), a.end(), std::greater_equal<>()) == a.end(),
          "expected angles that increase");
  require(
      a.front() >= -kHalfSpace_rad - kRounding_rad && a.back() <= kHalfSpace_rad + kRounding_rad,
      "expected angles of at most 90 degrees");
  const auto axis = std::find(a.begin(), a.end(), 0.0);
  require(axis != a.end() && a.back() > 0.0, "expected the angle 0 and angles above it");
  require(a.front() == 0.0 || !in_y.empty(), "expected angles from 0 on, or two planes");
  require(x_axis_.allFinite() && x_axis_.norm() > 0.5, "expected a direction that is not zero");
  for (const std::vector<double>* in : {&in_x, &in_y}) {
    if (in->empty() && in == &in_y) continue;
    require(in->size() == a.size(), "expected as many intensities as angles");
    require(
        std::all_of(in->begin(), in->end(), [](double v) { return v >= 0.0 && std::isfinite(v); }),
        "expected intensities of at least 0");
    require(*std::max_element(in->begin(), in->end()) > 0.0, "expected an intensity above 0");
    const auto is_whole = [&](double angle_rad, double value) {
      return value == 0.0 || std::abs(angle_rad) >= kHalfSpace_rad - kRounding_rad;
    };
    require(
        is_whole(a.back(), in->back()) && (a.front() == 0.0 || is_whole(a.front(), in->front())),
        "expected angles up to 90 degrees, or to where the intensity is 0");
  }
  const auto on_axis = static_cast<std::size_t>(axis - a.begin());
  require(in_y.empty() || in_x[on_axis] == in_y[on_axis],
          "expected the same intensity at the angle 0 in both planes");
  in_x_ = plane(std::move(in_x));
  if (!in_y.empty()) in_y_ = plane(std::move(in_y));
}

// Slopes by weighted harmonic means (Fritsch and Butland 1984); level where the intensity has an
// extremum.
LobeTable::Plane LobeTable::plane(std::vector<double> values) const {
  const std::vector<double>& a = angles_rad_;
  std::vector<double> slopes(a.size(), 0.0);
  for (std::size_t i = 1; i + 1 < a.size(); ++i) {
    const double before = a[i] - a[i - 1];
    const double after = a[i + 1] - a[i];
    const double rise = (values[i] - values[i - 1]) / before;
    const double next = (values[i + 1] - values[i]) / after;
    if (!(rise * next > 0.0)) continue;
    const double share = (before + 2.0 * after) / (3.0 * (before + after));
    slopes[i] = rise * next / (share * next + (1.0 - share) * rise);
  }
  // A lobe falls to the edge of the half-space without becoming level there. A round one is level
  // on its axis.
  const std::size_t n = a.size();
  if (n == 2) {
    slopes[1] = (values[1] - values[0]) / (a[1] - a[0]);
  } else {
    const auto rise = [&](std::size_t i) {
      return (values[i + 1] - values[i]) / (a[i + 1] - a[i]);
    };
    slopes[n - 1] = end_slope(a[n - 1] - a[n - 2], rise(n - 2), a[n - 2] - a[n - 3], rise(n - 3));
    if (a.front() < 0.0) slopes[0] = end_slope(a[1] - a[0], rise(0), a[2] - a[1], rise(1));
  }
  return {std::move(values), std::move(slopes)};
}

}  // namespace scattermeter
