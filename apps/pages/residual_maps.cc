#include "apps/pages/residual_maps.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scattermeter::apps {
namespace {

constexpr PictureColour kBehind = {28, 30, 34};
constexpr PictureColour kUnused = {120, 120, 120};
constexpr PictureColour kClipped = {213, 0, 50};
constexpr PictureColour kLeftOut = {230, 159, 0};

// A picture of the rectangle of the map with the values of its rows, at most `width_px` wide.
template <class ColourOfRow>
Picture row_picture(const SampleMap& map, int width_px, const ColourOfRow& colour_of_row) {
  const int step = (map.width + width_px - 1) / width_px;
  Picture out(map.width / step, map.height / step, kBehind);
  for (int y = 0; y < out.height_px; ++y) {
    for (int x = 0; x < out.width_px; ++x) {
      const auto at =
          static_cast<std::size_t>(y * step + step / 2) * static_cast<std::size_t>(map.width) +
          static_cast<std::size_t>(x * step + step / 2);
      const std::int32_t row = map.row_of_sample[at];
      if (row >= 0) out.set(x, y, colour_of_row(static_cast<std::size_t>(row)));
    }
  }
  return out;
}

// Colours are few enough for a palette, which halves the size of a page, and finer than the noise.
constexpr double kGreySteps = 100.0;
constexpr double kDifferenceSteps = 50.0;  // to each side

double in_steps(double value, double steps) { return std::round(value * steps) / steps; }

double brightest_of(const ShotRows& rows) {
  double out = 0.0;
  for (std::size_t j = 0; j < rows.observed.size(); ++j) {
    if (rows.state[j] == RowState::kUsed) out = std::max<double>(out, rows.observed[j]);
  }
  return out;
}

// A round number of percent that most of the differences do not exceed.
double round_up(double percent) {
  for (const double step : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (percent <= step) return step;
  }
  return 100.0;
}

}  // namespace

double difference_scale_percent(const ShotRows& rows) {
  std::vector<double> differences;
  for (std::size_t j = 0; j < rows.observed.size(); ++j) {
    if (rows.state[j] == RowState::kUsed) {
      differences.push_back(std::abs(static_cast<double>(rows.observed[j] - rows.predicted[j])));
    }
  }
  const double brightest = brightest_of(rows);
  if (differences.empty() || !(brightest > 0.0)) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(differences.size() - 1));
  std::nth_element(differences.begin(), differences.begin() + at, differences.end());
  return round_up(100.0 * differences[static_cast<std::size_t>(at)] / brightest);
}

ResidualMap residual_map(const ShotRows& rows, int width_px, double full_scale_percent) {
  const double brightest = brightest_of(rows);
  double squares = 0.0, light = 0.0;
  for (std::size_t j = 0; j < rows.observed.size(); ++j) {
    if (rows.state[j] != RowState::kUsed) continue;
    const double o = rows.observed[j];
    const double d = o - static_cast<double>(rows.predicted[j]);
    squares += d * d;
    light += o * o;
  }
  const double unit = full_scale_percent > 0.0 ? 0.01 * full_scale_percent * brightest : 1.0;
  const auto used = [&](std::size_t j) { return rows.state[j] == RowState::kUsed; };
  const auto grey = [&](float value) {
    return grey_colour(in_steps(static_cast<double>(value) / brightest, kGreySteps));
  };
  const Picture observed = row_picture(*rows.map, width_px, [&](std::size_t j) {
    if (rows.state[j] == RowState::kClipped) return kClipped;
    return used(j) ? grey(rows.observed[j]) : kLeftOut;
  });
  const Picture model = row_picture(*rows.map, width_px, [&](std::size_t j) {
    return used(j) ? grey(rows.predicted[j]) : kUnused;
  });
  const Picture difference = row_picture(*rows.map, width_px, [&](std::size_t j) {
    if (!used(j)) return kUnused;
    return difference_colour(in_steps(
        static_cast<double>(rows.observed[j] - rows.predicted[j]) / unit, kDifferenceSteps));
  });
  return {side_by_side({observed, model, difference}, 4),
          light > 0.0 ? std::sqrt(squares / light) : 0.0};
}

}  // namespace scattermeter::apps
