#include "core/view/observation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/camera/sensor_noise.h"
#include "core/view/row_mean.h"

namespace scattermeter {
namespace {

// One channel over one row.
struct Sum {
  RowSum l;
  double counts = 0, factor = 0;
  double growth = 0;  // factor times variance_per_count
  std::size_t clipped = 0;
};

// Squared second differences of neighbouring samples, and what their variances predict of them.
struct Scatter {
  double squared = 0, expected = 0, n = 0;

  // Three samples of one phase in line: the second difference is free of the slope.
  void add(const CfaSamples& samples, std::size_t i) {
    const double d =
        static_cast<double>(samples.signal_counts[i] - 2.0F * samples.signal_counts[i + 2] +
                            samples.signal_counts[i + 4]);
    squared += d * d;
    expected += static_cast<double>(samples.variance_counts2[i]) +
                4.0 * static_cast<double>(samples.variance_counts2[i + 2]) +
                static_cast<double>(samples.variance_counts2[i + 4]);
    n += 1.0;
  }
  // ChannelObservation::noise_excess
  double excess() const {
    constexpr double kMatters = 1.3, kStds = 6.0;
    const double chance = kStds * std::sqrt(2.0 * kSecondDifferenceOverlap / std::max(n, 1.0));
    return squared > std::max(kMatters, 1.0 + chance) * expected ? squared / expected : 1.0;
  }
};

struct SampleSums {
  std::array<std::vector<Sum>, kRgb> channel;  // by row
  std::array<Scatter, kRgb> scatter;
  std::vector<Monomials> monomials;     // by row, sum over the samples of all channels
  std::vector<Eigen::Vector2i> origin;  // by row: its first sample, px
};

// Sums over all samples of the map's rows; counts the samples of each channel in `out`.
SampleSums sum_samples(const CfaSamples& samples, const SampleMap& map, Observation& out) {
  const std::size_t n_rows = map.patch_of_row.size();
  SampleSums sums;
  for (auto& s : sums.channel) s.resize(n_rows);
  sums.monomials.assign(n_rows, Monomials::Zero());
  sums.origin.resize(n_rows);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                            static_cast<std::size_t>(x);
      if (map.row_of_sample[i] < 0) continue;
      const auto row = static_cast<std::size_t>(map.row_of_sample[i]);
      const auto c = static_cast<std::size_t>(samples.channel(map.x0 + x, map.y0 + y));
      if (sums.monomials[row][0] == 0.0) sums.origin[row] = {x, y};
      const Monomials from_origin = monomials_at(Eigen::Vector2i(x, y) - sums.origin[row]);
      sums.monomials[row] += from_origin;
      Sum& s = sums.channel[c][row];
      if (samples.clipped[i] == kSampleDefect) continue;
      ++out.channel[c].samples;
      if (samples.clipped[i] != 0) {
        ++s.clipped;
        ++out.channel[c].samples_clipped;
        continue;
      }
      const auto factor = static_cast<double>(map.pi_over_transmittance[i]);
      const auto counts = static_cast<double>(samples.signal_counts[i]);
      s.counts += counts;
      s.factor += factor;
      s.growth += factor * (samples.variance_per_count_of.empty()
                                ? samples.variance_per_count
                                : static_cast<double>(samples.variance_per_count_of[i]));
      s.l.add(from_origin, factor * counts,
              factor * factor * static_cast<double>(samples.variance_counts2[i]));
      const bool in_line = x + 4 < map.width && map.row_of_sample[i + 2] == map.row_of_sample[i] &&
                           map.row_of_sample[i + 4] == map.row_of_sample[i];
      if (in_line && samples.clipped[i + 2] == 0 && samples.clipped[i + 4] == 0) {
        sums.scatter[c].add(samples, i);
      }
    }
  }
  return sums;
}

// Mean of channel c over the samples of all channels on the row, which is what the row's site
// represents.
RowMean mean_of_row(const SampleSums& sums, const SampleMap& map, std::size_t c, std::size_t row) {
  RowFit fit(sums.channel[c][row].l);
  if (!map.adjacent_rows.empty() && !fit.suffices()) {
    for (const std::int32_t k : map.adjacent_rows[row]) {
      const auto other = static_cast<std::size_t>(k);
      const Sum& s = sums.channel[c][other];
      if (s.clipped > 0 || s.l.n() == 0.0) continue;
      fit.add_neighbour(s.l, sums.origin[other] - sums.origin[row]);
    }
  }
  return fit.mean_over(sums.monomials[row] / sums.monomials[row][0]);
}

// One channel of all rows. unit: W/(mm^2 sr) of one count.
void observe_channel(const SampleSums& sums, const SampleMap& map, std::size_t c, double unit,
                     double floor_counts, ChannelObservation& channel) {
  const std::size_t n_rows = map.patch_of_row.size();
  channel.l.assign(n_rows, 0.0);
  channel.variance.assign(n_rows, 0.0);
  channel.variance_per_l.assign(n_rows, 0.0);
  channel.l_per_count.assign(n_rows, 0.0);
  channel.state.assign(n_rows, RowState::kNoSamples);
  channel.noise_excess = sums.scatter[c].excess();
  for (std::size_t row = 0; row < n_rows; ++row) {
    const Sum& s = sums.channel[c][row];
    const double n = s.l.n();
    if (n == 0.0 && s.clipped == 0) continue;
    // A clipped sample is a lower bound; leaving out only that sample would bias the mean low.
    if (s.clipped > 0) {
      channel.state[row] = RowState::kClipped;
      ++channel.rows_clipped;
      continue;
    }
    channel.brightest_counts = std::max(channel.brightest_counts, s.counts / n);
    if (s.counts / n < floor_counts) {
      channel.state[row] = RowState::kFloor;
      ++channel.rows_floor;
      continue;
    }
    const RowMean mean = mean_of_row(sums, map, c, row);
    channel.l[row] = unit * mean.value;
    channel.variance[row] = channel.noise_excess * unit * unit * mean.variance;
    // Samples of l / (unit factor) counts: sum of factor^2 variance_per_count l / (unit factor).
    channel.variance_per_l[row] = channel.noise_excess * unit * s.growth / (n * n) * mean.spread;
    channel.l_per_count[row] = unit * s.factor / n;
    channel.state[row] = RowState::kUsed;
    channel.brightest_snr = std::max(channel.brightest_snr, mean.value / std::sqrt(mean.variance));
    ++channel.rows_used;
  }
}

// How much each exposure of a bracket contributes to each row: its parts of the samples, weighted
// as their counts are in l.
void add_exposure_parts(const CfaSamples& samples, const SampleMap& map, Observation& out) {
  const std::size_t n_rows = map.patch_of_row.size();
  for (const std::vector<float>& part : samples.part_of_exposure) {
    std::array<std::vector<double>, kRgb> factor;
    for (std::size_t c = 0; c < kRgb; ++c) {
      out.channel[c].exposures.push_back({std::vector<double>(n_rows, 0.0), 0});
      factor[c].assign(n_rows, 0.0);
    }
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (map.row_of_sample[i] < 0 || samples.clipped[i] == kSampleDefect) continue;
      const auto row = static_cast<std::size_t>(map.row_of_sample[i]);
      const auto width = static_cast<std::size_t>(map.width);
      const auto c = static_cast<std::size_t>(samples.channel(
          map.x0 + static_cast<int>(i % width), map.y0 + static_cast<int>(i / width)));
      const auto weight = static_cast<double>(map.pi_over_transmittance[i]);
      ExposurePart& of = out.channel[c].exposures.back();
      of.of_row[row] += weight * static_cast<double>(part[i]);
      factor[c][row] += weight;
      if (part[i] > 0.0F) ++of.samples;
    }
    for (std::size_t c = 0; c < kRgb; ++c) {
      for (std::size_t row = 0; row < n_rows; ++row) {
        if (factor[c][row] > 0.0) out.channel[c].exposures.back().of_row[row] /= factor[c][row];
      }
    }
  }
}

}  // namespace

Observation observe(const CfaSamples& samples, const SampleMap& map,
                    const std::array<double, kRgb>& responsivity_counts_mm2_sr_per_W_s) {
  if (samples.x0 != map.x0 || samples.y0 != map.y0 || samples.width != map.width ||
      samples.height != map.height) {
    throw std::invalid_argument("observe: the rectangles of samples and map differ");
  }
  if (!(samples.exposure_s > 0.0))
    throw std::invalid_argument("observe: exposure_s is not positive");
  Observation out;
  const SampleSums sums = sum_samples(samples, map, out);
  for (std::size_t c = 0; c < kRgb; ++c) {
    const double unit = 1.0 / (responsivity_counts_mm2_sr_per_W_s[c] * samples.exposure_s);
    observe_channel(sums, map, c, unit, samples.floor_counts, out.channel[c]);
  }
  add_exposure_parts(samples, map, out);
  return out;
}

}  // namespace scattermeter
