#include "core/view/chosen_rows.h"

#include <algorithm>
#include <limits>

#include "core/base/position_cells.h"

namespace scattermeter {
namespace {

template <class T>
std::vector<T> some(const std::vector<T>& all, const std::vector<std::size_t>& rows) {
  std::vector<T> out;
  out.reserve(rows.size());
  for (const std::size_t row : rows) out.push_back(all.at(row));
  return out;
}

ChannelObservation with_rows(const ChannelObservation& all, const std::vector<std::size_t>& rows) {
  ChannelObservation out;
  out.l = some(all.l, rows);
  out.variance = some(all.variance, rows);
  out.variance_per_l = some(all.variance_per_l, rows);
  out.l_per_count = some(all.l_per_count, rows);
  out.state = some(all.state, rows);
  const auto count = [&](RowState state) {
    return static_cast<std::size_t>(std::count(out.state.begin(), out.state.end(), state));
  };
  out.rows_used = count(RowState::kUsed);
  out.rows_clipped = count(RowState::kClipped);
  out.rows_floor = count(RowState::kFloor);
  out.samples = all.samples;
  out.samples_clipped = all.samples_clipped;
  out.brightest_counts = all.brightest_counts;
  out.brightest_snr = all.brightest_snr;
  out.noise_excess = all.noise_excess;
  for (const ExposurePart& part : all.exposures) {
    out.exposures.push_back({some(part.of_row, rows), part.samples});
  }
  return out;
}

}  // namespace

RowChoice spread_rows(const std::vector<Eigen::Vector3d>& centers_mm, int levels) {
  const std::vector<int> cell = position_cells(centers_mm, levels, 1);
  const std::size_t n_cells =
      cell.empty() ? 0 : 1 + static_cast<std::size_t>(*std::max_element(cell.begin(), cell.end()));
  std::vector<Eigen::Vector3d> sum(n_cells, Eigen::Vector3d::Zero());
  std::vector<double> count(n_cells, 0.0);
  for (std::size_t j = 0; j < cell.size(); ++j) {
    sum[static_cast<std::size_t>(cell[j])] += centers_mm[j];
    count[static_cast<std::size_t>(cell[j])] += 1.0;
  }
  std::vector<double> least(n_cells, std::numeric_limits<double>::infinity());
  std::vector<std::size_t> row_of_cell(n_cells, 0);
  for (std::size_t j = 0; j < cell.size(); ++j) {
    const auto k = static_cast<std::size_t>(cell[j]);
    const double distance = (centers_mm[j] - sum[k] / count[k]).squaredNorm();
    if (!(distance < least[k])) continue;
    least[k] = distance;
    row_of_cell[k] = j;
  }
  RowChoice out{row_of_cell, std::vector<std::int32_t>(cell.size())};
  std::sort(out.rows.begin(), out.rows.end());
  for (std::size_t j = 0; j < cell.size(); ++j) {
    const auto at = std::lower_bound(out.rows.begin(), out.rows.end(),
                                     row_of_cell[static_cast<std::size_t>(cell[j])]);
    out.stands_for_it[j] = static_cast<std::int32_t>(at - out.rows.begin());
  }
  return out;
}

SampleMap with_rows(const SampleMap& map, const RowChoice& choice) {
  SampleMap out;
  out.x0 = map.x0;
  out.y0 = map.y0;
  out.width = map.width;
  out.height = map.height;
  out.row_of_sample = map.row_of_sample;
  for (std::int32_t& row : out.row_of_sample) {
    if (row >= 0) row = choice.stands_for_it.at(static_cast<std::size_t>(row));
  }
  out.patch_of_row = some(map.patch_of_row, choice.rows);
  out.samples = some(map.samples, choice.rows);
  out.of_quarters = some(map.of_quarters, choice.rows);
  out.coverage = some(map.coverage, choice.rows);
  out.guarded_of_row = some(map.guarded_of_row, choice.rows);
  out.samples_on_object = map.samples_on_object;
  out.samples_guarded = map.samples_guarded;
  out.patches_partly_seen = map.patches_partly_seen;
  return out;
}

Observation with_rows(const Observation& observation, const RowChoice& choice) {
  Observation out;
  for (std::size_t c = 0; c < kRgb; ++c) {
    out.channel[c] = with_rows(observation.channel[c], choice.rows);
  }
  return out;
}

}  // namespace scattermeter
