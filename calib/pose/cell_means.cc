#include "calib/pose/cell_means.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace scattermeter::calib {

CfaSamples cell_means(const CfaSamples& samples, int factor) {
  if (factor < 2 || factor % 2 != 0) {
    throw std::invalid_argument("cell_means: factor must be even, got " + std::to_string(factor));
  }
  const auto up = [factor](int v) { return (v + factor - 1) / factor; };
  CfaSamples out;
  out.x0 = up(samples.x0);
  out.y0 = up(samples.y0);
  out.width = std::max(0, (samples.x0 + samples.width) / factor - out.x0);
  out.height = std::max(0, (samples.y0 + samples.height) / factor - out.y0);
  out.channel_of_phase = {1, 1, 1, 1};
  out.exposure_s = samples.exposure_s;
  const double n = static_cast<double>(factor) * factor;
  out.variance_per_count = samples.variance_per_count / n;
  out.floor_counts = samples.floor_counts;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      double signal = 0;
      double variance = 0;
      std::uint8_t clipped = 0;
      for (int j = 0; j < factor; ++j) {
        const std::size_t row = static_cast<std::size_t>((out.y0 + y) * factor + j - samples.y0) *
                                static_cast<std::size_t>(samples.width);
        for (int i = 0; i < factor; ++i) {
          const std::size_t at =
              row + static_cast<std::size_t>((out.x0 + x) * factor + i - samples.x0);
          signal += static_cast<double>(samples.signal_counts[at]);
          variance += static_cast<double>(samples.variance_counts2[at]);
          clipped = std::max(clipped, samples.clipped[at]);
        }
      }
      out.signal_counts.push_back(static_cast<float>(signal / n));
      out.variance_counts2.push_back(static_cast<float>(variance / (n * n)));
      out.clipped.push_back(clipped);
    }
  }
  return out;
}

}  // namespace scattermeter::calib
