// Variance of a raw sample.
#pragma once

#include <array>
#include <vector>

#include "capture/raw_frame.h"

namespace scattermeter::capture {

// The sensor at the shot's ISO setting.
struct SensorNoise {
  double gain_e_per_count = 6.0;   // electrons per count, > 0
  double read_noise_counts = 1.0;  // standard deviation in the dark, in counts, >= 0
};

// Variance of a sample of value v, in counts^2:
//   var(v) = max(v - black, 0) / gain          photon noise (Poisson in electrons)
//          + read_noise^2                      amplifier and converter
//          + step(v)^2 / 12                    uniform error inside the quantisation step at v
// step(v) is 1 for the identity curve, else the mean distance from v to its neighbours among
// `curve_levels` (one neighbour at the ends).
class NoiseModel {
 public:
  // Throws std::invalid_argument for a gain <= 0, a negative read noise or a NaN.
  NoiseModel(const SensorNoise& sensor, const RawFrame& frame);
  // phase: index as in CfaPattern::phase.
  double variance_counts2(std::uint16_t value_counts, int phase) const {
    return table_[static_cast<std::size_t>(phase)][value_counts];
  }

 private:
  std::array<std::vector<float>, 4> table_;  // per phase, 65536 values
};

}  // namespace scattermeter::capture
