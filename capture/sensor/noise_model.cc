#include "capture/sensor/noise_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace scattermeter::capture {
namespace {

constexpr std::size_t kTableValues = 65536;

// The distance between neighbouring levels at each value. A value that is not a level (which the
// decoder never returns) has the gap that it lies in, beyond the ends the last gap.
std::vector<double> steps_of(const std::vector<std::uint16_t>& levels) {
  std::vector<double> steps(kTableValues, 1.0);
  if (levels.size() < 2) return steps;
  for (std::size_t value = 0; value < kTableValues; ++value) {
    const auto above = std::upper_bound(levels.begin(), levels.end(), value);
    const auto not_below = std::lower_bound(levels.begin(), levels.end(), value);
    const auto low = std::max<std::ptrdiff_t>(not_below - levels.begin() - 1, 0);
    const auto high = std::min<std::ptrdiff_t>(above - levels.begin(),
                                               static_cast<std::ptrdiff_t>(levels.size()) - 1);
    const bool is_level = not_below != above;
    const bool beyond = low == high;
    if (beyond) {
      steps[value] = low == 0 ? levels[1] - levels[0] : levels.back() - levels[levels.size() - 2];
      continue;
    }
    const double span =
        levels[static_cast<std::size_t>(high)] - levels[static_cast<std::size_t>(low)];
    steps[value] = is_level ? span / static_cast<double>(high - low) : span;
  }
  return steps;
}

}  // namespace

NoiseModel::NoiseModel(const SensorNoise& sensor, const RawFrame& frame) {
  if (!(sensor.gain_e_per_count > 0) || !std::isfinite(sensor.gain_e_per_count)) {
    throw std::invalid_argument("NoiseModel: gain_e_per_count must be positive, got " +
                                std::to_string(sensor.gain_e_per_count));
  }
  if (!(sensor.read_noise_counts >= 0) || !std::isfinite(sensor.read_noise_counts)) {
    throw std::invalid_argument("NoiseModel: read_noise_counts must not be negative, got " +
                                std::to_string(sensor.read_noise_counts));
  }
  const double read_variance = sensor.read_noise_counts * sensor.read_noise_counts;
  const std::vector<double> steps = steps_of(frame.curve_levels);
  for (std::size_t phase = 0; phase < table_.size(); ++phase) {
    table_[phase].resize(kTableValues);
    for (std::size_t value = 0; value < kTableValues; ++value) {
      const double signal = std::max(static_cast<double>(value) - frame.black_counts[phase], 0.0);
      table_[phase][value] = static_cast<float>(signal / sensor.gain_e_per_count + read_variance +
                                                steps[value] * steps[value] / 12.0);
    }
  }
}

}  // namespace scattermeter::capture
