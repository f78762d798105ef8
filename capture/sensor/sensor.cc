#include "capture/sensor/sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "capture/raw/tone_curve.h"

namespace scattermeter::capture {
namespace {

constexpr double kNormalAbove_e = 1000.0;

void check(const SensorModel& sensor) {
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument("expose: " + what);
  };
  if (!(sensor.noise.gain_e_per_count > 0) || !std::isfinite(sensor.noise.gain_e_per_count)) {
    refuse("gain_e_per_count must be positive, got " +
           std::to_string(sensor.noise.gain_e_per_count));
  }
  if (!(sensor.noise.read_noise_counts >= 0) || !std::isfinite(sensor.noise.read_noise_counts)) {
    refuse("read_noise_counts must not be negative, got " +
           std::to_string(sensor.noise.read_noise_counts));
  }
  if (sensor.white_counts < 1 || sensor.white_counts > 65535) {
    refuse("white_counts must lie in 1 .. 65535, got " + std::to_string(sensor.white_counts));
  }
  if (!(std::abs(sensor.departure_at_white) < 0.5)) {
    refuse("departure_at_white must lie within 0.5, got " +
           std::to_string(sensor.departure_at_white));
  }
  if (!std::isfinite(sensor.black_offset_counts)) refuse("black_offset_counts must be finite");
  if (!std::is_sorted(sensor.tone_curve.begin(), sensor.tone_curve.end())) {
    refuse("tone_curve must ascend");
  }
}

// The code of every count of the converter, 0 .. white_counts.
std::vector<std::uint16_t> code_table(const SensorModel& sensor) {
  std::vector<std::uint16_t> codes(static_cast<std::size_t>(sensor.white_counts) + 1);
  for (std::size_t count = 0; count < codes.size(); ++count) {
    codes[count] = sensor.tone_curve.empty()
                       ? static_cast<std::uint16_t>(count)
                       : nearest_code(sensor.tone_curve, static_cast<double>(count));
  }
  return codes;
}

// Converts linear counts to recorded counts.
struct Departure {
  double per_count = 0;
  double operator()(double counts) const { return counts * (1.0 + per_count * counts); }
};

Departure departure_of(const SensorModel& sensor) {
  const int black = *std::min_element(sensor.black_counts.begin(), sensor.black_counts.end());
  return {sensor.departure_at_white / std::max(1, sensor.white_counts - black)};
}

// The random numbers of one row.
class RowNoise {
 public:
  RowNoise(const SensorNoise& noise, const Departure& departure, std::uint64_t seed,
           std::uint64_t row)
      : noise_(noise), departure_(departure) {
    // std::seed_seq mixes all words into the whole state, so that neighbouring rows are
    // independent.
    std::seed_seq words{seed & 0xffffffffU, seed >> 32U, row & 0xffffffffU, row >> 32U};
    generator_.seed(words);
  }

  double draw(double signal_counts) {
    const double electrons = signal_counts * noise_.gain_e_per_count;
    const double read = noise_.read_noise_counts * normal_(generator_);
    return departure_(photon(electrons) / noise_.gain_e_per_count) + read;
  }

 private:
  double photon(double electrons) {
    if (electrons <= 0) return 0;  // std::poisson_distribution requires a positive mean
    if (electrons > kNormalAbove_e) return electrons + std::sqrt(electrons) * normal_(generator_);
    return static_cast<double>(std::poisson_distribution<int>(electrons)(generator_));
  }

  SensorNoise noise_;
  Departure departure_;
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace

std::vector<std::uint16_t> expose(const std::vector<float>& signal_counts, int width_px,
                                  int height_px, const SensorModel& sensor, std::uint64_t seed) {
  if (width_px <= 0 || height_px <= 0 ||
      signal_counts.size() !=
          static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("expose: " + std::to_string(width_px) + " x " +
                                std::to_string(height_px) + " values expected, got " +
                                std::to_string(signal_counts.size()));
  }
  check(sensor);
  for (std::size_t i = 0; i < signal_counts.size(); ++i) {
    if (!(signal_counts[i] >= 0) || !std::isfinite(signal_counts[i])) {
      throw std::invalid_argument("expose: signal_counts[" + std::to_string(i) +
                                  "] must be finite and not negative, got " +
                                  std::to_string(signal_counts[i]));
    }
  }

  const std::vector<std::uint16_t> codes = code_table(sensor);
  const Departure departure = departure_of(sensor);
  const auto width = static_cast<std::size_t>(width_px);
  std::vector<std::uint16_t> stored(signal_counts.size());
  const auto expose_row = [&](std::size_t y) {
    RowNoise noise(sensor.noise, departure, seed, y);
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t i = y * width + x;
      const double signal = signal_counts[i];
      const double counts = (sensor.noise_on ? noise.draw(signal) : departure(signal)) +
                            sensor.black_counts[2 * (y % 2) + x % 2] + sensor.black_offset_counts;
      const double clipped = std::clamp(std::round(counts), 0.0, double(sensor.white_counts));
      stored[i] = codes[static_cast<std::size_t>(clipped)];
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, static_cast<std::size_t>(height_px), 16),
                    [&](const tbb::blocked_range<std::size_t>& rows) {
                      for (std::size_t y = rows.begin(); y != rows.end(); ++y) expose_row(y);
                    });
  return stored;
}

}  // namespace scattermeter::capture
