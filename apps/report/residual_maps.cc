#include "apps/report/residual_maps.h"

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

// A round number of percent that most of the differences do not exceed.
double round_up(double percent) {
  for (const double step : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (percent <= step) return step;
  }
  return 100.0;
}

}  // namespace

ResidualMap residual_map(const ShotRows& rows, int width_px) {
  double brightest = 0.0;
  double squares = 0.0;
  double light = 0.0;
  std::vector<double> differences;
  for (std::size_t j = 0; j < rows.observed.size(); ++j) {
    if (rows.state[j] != RowState::kUsed) continue;
    const double o = rows.observed[j];
    const double d = o - static_cast<double>(rows.predicted[j]);
    brightest = std::max(brightest, o);
    squares += d * d;
    light += o * o;
    differences.push_back(std::abs(d));
  }
  double scale = 0.0;
  if (!differences.empty() && brightest > 0.0) {
    const auto at = static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(differences.size() - 1));
    std::nth_element(differences.begin(), differences.begin() + at, differences.end());
    scale = round_up(100.0 * differences[static_cast<std::size_t>(at)] / brightest);
  }
  const double unit = scale > 0.0 ? 0.01 * scale * brightest : 1.0;
  const auto used = [&](std::size_t j) { return rows.state[j] == RowState::kUsed; };
  const Picture observed = row_picture(*rows.map, width_px, [&](std::size_t j) {
    if (rows.state[j] == RowState::kClipped) return kClipped;
    if (!used(j)) return kLeftOut;
    return grey_colour(static_cast<double>(rows.observed[j]) / brightest);
  });
  const Picture model = row_picture(*rows.map, width_px, [&](std::size_t j) {
    return used(j) ? grey_colour(static_cast<double>(rows.predicted[j]) / brightest) : kUnused;
  });
  const Picture difference = row_picture(*rows.map, width_px, [&](std::size_t j) {
    return used(j)
               ? difference_colour(static_cast<double>(rows.observed[j] - rows.predicted[j]) / unit)
               : kUnused;
  });
  return {side_by_side({observed, model, difference}, 4),
          light > 0.0 ? std::sqrt(squares / light) : 0.0, scale};
}

}  // namespace scattermeter::apps
