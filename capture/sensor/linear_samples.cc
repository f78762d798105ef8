#include "capture/sensor/linear_samples.h"

#include <algorithm>
#include <stdexcept>

#include "capture/sensor/saturation.h"

namespace scattermeter::capture {

CfaSamples linear_samples(const RawFrame& frame, const SensorNoise& sensor, double exposure_s,
                          int x0, int y0, int width, int height) {
  if (x0 < 0 || y0 < 0 || width < 0 || height < 0 || x0 + width > frame.width_px ||
      y0 + height > frame.height_px) {
    throw std::invalid_argument("linear_samples: the rectangle is not inside the frame");
  }
  if (!(exposure_s > 0.0))
    throw std::invalid_argument("linear_samples: exposure_s is not positive");
  CfaSamples out;
  out.x0 = x0;
  out.y0 = y0;
  out.width = width;
  out.height = height;
  out.exposure_s = exposure_s;
  for (std::size_t p = 0; p < 4; ++p) {
    out.channel_of_phase[p] = static_cast<int>(frame.cfa.phase[p]);
    const double above_zero = frame.black_counts[p];
    const double wanted = 4.0 * sensor.read_noise_counts;
    if (above_zero < wanted) out.floor_counts = std::max(out.floor_counts, wanted - above_zero);
  }
  const NoiseModel noise(sensor, frame);
  out.variance_per_count = 1.0 / sensor.gain_e_per_count;
  const std::array<double, 4> clip = clip_levels(frame);
  const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  out.signal_counts.resize(n);
  out.variance_counts2.resize(n);
  out.clipped.resize(n);
  std::size_t i = 0;
  for (int y = y0; y < y0 + height; ++y) {
    for (int x = x0; x < x0 + width; ++x, ++i) {
      const int phase = 2 * (y & 1) + (x & 1);
      const auto p = static_cast<std::size_t>(phase);
      const std::uint16_t v = frame.at(x, y);
      out.signal_counts[i] = static_cast<float>(v - frame.black_counts[p]);
      out.variance_counts2[i] = static_cast<float>(noise.variance_counts2(v, phase));
      out.clipped[i] = static_cast<double>(v) >= clip[p] ? 1 : 0;
    }
  }
  return out;
}

}  // namespace scattermeter::capture
