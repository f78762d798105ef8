#include "capture/sensor/noise_curve.h"

#include <cmath>
#include <map>
#include <stdexcept>

#include "core/camera/sensor_noise.h"

namespace scattermeter::capture {

std::array<std::vector<NoisePoint>, kRgb> noise_curve(const CfaSamples& samples,
                                                      const SampleMap& map) {
  if (samples.x0 != map.x0 || samples.y0 != map.y0 || samples.width != map.width ||
      samples.height != map.height) {
    throw std::invalid_argument("noise_curve: the rectangles of samples and map differ");
  }
  std::array<std::map<int, NoisePoint>, kRgb> bins;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x + 4 < map.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                            static_cast<std::size_t>(x);
      const std::int32_t row = map.row_of_sample[i];
      if (row < 0 || map.row_of_sample[i + 2] != row || map.row_of_sample[i + 4] != row) continue;
      if (samples.clipped[i] + samples.clipped[i + 2] + samples.clipped[i + 4] != 0) continue;
      const double a = samples.signal_counts[i];
      const double b = samples.signal_counts[i + 2];
      const double c = samples.signal_counts[i + 4];
      const double mean = (a + b + c) / 3.0;
      if (!(mean >= 1.0)) continue;
      const auto channel = static_cast<std::size_t>(samples.channel(map.x0 + x, map.y0 + y));
      NoisePoint& p = bins[channel][static_cast<int>(std::floor(2.0 * std::log2(mean)))];
      const double difference = a - 2.0 * b + c;
      p.mean_counts += mean;
      p.variance_counts2 += difference * difference / 6.0;
      p.model_counts2 += (static_cast<double>(samples.variance_counts2[i]) +
                          4.0 * static_cast<double>(samples.variance_counts2[i + 2]) +
                          static_cast<double>(samples.variance_counts2[i + 4])) /
                         6.0;
      ++p.triples;
    }
  }
  std::array<std::vector<NoisePoint>, kRgb> out;
  for (std::size_t channel = 0; channel < kRgb; ++channel) {
    for (const auto& [bin, sum] : bins[channel]) {
      const auto n = static_cast<double>(sum.triples);
      NoisePoint p = sum;
      p.mean_counts /= n;
      p.variance_counts2 /= n;
      p.model_counts2 /= n;
      p.relative_std = std::sqrt(2.0 * kSecondDifferenceOverlap / n);
      out[channel].push_back(p);
    }
  }
  return out;
}

}  // namespace scattermeter::capture
