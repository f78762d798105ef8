#include "apps/residual_maps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/shot_picture.h"

namespace scattermeter::apps {
namespace {

constexpr PictureColour kBehind = {28, 30, 34};
constexpr PictureColour kUnused = {120, 120, 120};
constexpr PictureColour kLeftOut = {230, 159, 0};

// A round number of percent that holds most of the differences.
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
  const Picture observed = row_picture(*rows.map, width_px, kBehind, [&](std::size_t j) {
    if (rows.state[j] == RowState::kClipped) return kClippedColour;
    if (!used(j)) return kLeftOut;
    return grey_colour(static_cast<double>(rows.observed[j]) / brightest);
  });
  const Picture model = row_picture(*rows.map, width_px, kBehind, [&](std::size_t j) {
    return used(j) ? grey_colour(static_cast<double>(rows.predicted[j]) / brightest) : kUnused;
  });
  const Picture difference = row_picture(*rows.map, width_px, kBehind, [&](std::size_t j) {
    return used(j)
               ? difference_colour(static_cast<double>(rows.observed[j] - rows.predicted[j]) / unit)
               : kUnused;
  });
  return {side_by_side({observed, model, difference}, 4),
          light > 0.0 ? std::sqrt(squares / light) : 0.0, scale};
}

}  // namespace scattermeter::apps
