#include "capture/sensor/ideal_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "capture/raw/tone_curve.h"
#include "capture/sensor/noise_model.h"

namespace scattermeter::capture {

CfaSamples ideal_samples(const std::vector<float>& signal_counts, int x0, int y0, int width,
                         int height, const SensorModel& sensor, const CfaPattern& cfa,
                         double exposure_s) {
  if (x0 < 0 || y0 < 0 || width < 0 || height < 0 ||
      signal_counts.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    throw std::invalid_argument("ideal_samples: " + std::to_string(width) + " x " +
                                std::to_string(height) + " values from (" + std::to_string(x0) +
                                ", " + std::to_string(y0) + ") on expected, got " +
                                std::to_string(signal_counts.size()));
  }
  if (!(exposure_s > 0.0)) throw std::invalid_argument("ideal_samples: exposure_s is not positive");
  CfaSamples out;
  out.x0 = x0;
  out.y0 = y0;
  out.width = width;
  out.height = height;
  out.exposure_s = exposure_s;
  out.signal_counts = signal_counts;
  out.variance_counts2.resize(signal_counts.size());
  out.clipped.resize(signal_counts.size());
  RawFrame scale;  // the members of a frame that the noise model uses
  scale.curve_levels = sensor.tone_curve;
  for (std::size_t p = 0; p < 4; ++p) {
    out.channel_of_phase[p] = static_cast<int>(cfa.phase[p]);
    scale.black_counts[p] = sensor.black_counts[p];
  }
  const NoiseModel noise(sensor.noise, scale);
  double top = sensor.white_counts;
  if (!sensor.tone_curve.empty()) top = std::min<double>(top, sensor.tone_curve.back());
  std::size_t i = 0;
  for (int y = y0; y < y0 + height; ++y) {
    for (int x = x0; x < x0 + width; ++x, ++i) {
      const std::size_t phase = cfa_phase(x, y);
      const double counts = static_cast<double>(signal_counts[i]) + scale.black_counts[phase];
      auto nearest = static_cast<std::uint16_t>(
          std::clamp(std::round(counts), 0.0, static_cast<double>(sensor.white_counts)));
      if (!sensor.tone_curve.empty()) {
        nearest = sensor.tone_curve[nearest_code(sensor.tone_curve, nearest)];
      }
      out.variance_counts2[i] =
          static_cast<float>(noise.variance_counts2(nearest, static_cast<int>(phase)));
      out.clipped[i] = nearest >= top ? 1 : 0;
    }
  }
  return out;
}

}  // namespace scattermeter::capture
