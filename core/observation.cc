#include "core/observation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scattermeter {

Observation observe(const CfaSamples& samples, const SampleMap& map,
                    const std::array<double, kRgb>& responsivity) {
  if (samples.x0 != map.x0 || samples.y0 != map.y0 || samples.width != map.width ||
      samples.height != map.height) {
    throw std::invalid_argument("observe: the samples' rectangle is not the map's");
  }
  if (!(samples.exposure_s > 0.0))
    throw std::invalid_argument("observe: exposure_s is not positive");
  const std::size_t n_rows = map.patch_of_row.size();
  struct Sum {
    double l = 0, variance = 0, counts = 0;
    std::size_t n = 0, clipped = 0;
  };
  std::array<std::vector<Sum>, kRgb> sums;
  for (auto& s : sums) s.resize(n_rows);
  Observation out;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                            static_cast<std::size_t>(x);
      const int row = map.row_of_sample[i];
      if (row < 0) continue;
      const auto c = static_cast<std::size_t>(samples.channel(map.x0 + x, map.y0 + y));
      Sum& s = sums[c][static_cast<std::size_t>(row)];
      ++out.channel[c].samples;
      ++s.n;
      if (samples.clipped[i] != 0) {
        ++s.clipped;
        ++out.channel[c].samples_clipped;
        continue;
      }
      const double k = static_cast<double>(map.pi_over_transmittance[i]);
      s.l += k * static_cast<double>(samples.signal_counts[i]);
      s.variance += k * k * static_cast<double>(samples.variance_counts2[i]);
      s.counts += static_cast<double>(samples.signal_counts[i]);
    }
  }
  for (std::size_t c = 0; c < kRgb; ++c) {
    ChannelObservation& channel = out.channel[c];
    channel.l.assign(n_rows, 0.0);
    channel.variance.assign(n_rows, 0.0);
    channel.state.assign(n_rows, RowState::kNoSamples);
    const double unit = 1.0 / (responsivity[c] * samples.exposure_s);
    for (std::size_t row = 0; row < n_rows; ++row) {
      const Sum& s = sums[c][row];
      if (s.n == 0) continue;
      // A clipped sample is a lower bound; leaving only it out would pull the mean down.
      if (s.clipped > 0) {
        channel.state[row] = RowState::kClipped;
        ++channel.rows_clipped;
        continue;
      }
      const double n = static_cast<double>(s.n);
      channel.brightest_counts = std::max(channel.brightest_counts, s.counts / n);
      if (s.counts / n < samples.floor_counts) {
        channel.state[row] = RowState::kFloor;
        ++channel.rows_floor;
        continue;
      }
      channel.l[row] = unit * s.l / n;
      channel.variance[row] = unit * unit * s.variance / (n * n);
      channel.state[row] = RowState::kUsed;
      channel.brightest_snr =
          std::max(channel.brightest_snr, channel.l[row] / std::sqrt(channel.variance[row]));
      ++channel.rows_used;
    }
  }
  return out;
}

}  // namespace scattermeter
