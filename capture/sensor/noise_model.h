// Noise model: the variance of a raw sample.
#pragma once

#include <array>
#include <vector>

#include "capture/raw/raw_frame.h"
#include "core/camera/sensor_noise.h"

namespace scattermeter::capture {

// The variance of a sample of value v, in counts^2:
//   var(v) = max(v - black, 0) / gain          photon noise (Poisson in electrons)
//          + read_noise^2                      amplifier and converter
//          + step(v)^2 / 12                    uniform error within the quantisation step at v
// step(v) is 1 for the identity curve, else the mean distance from v to its neighbours in
// `curve_levels` (to the one neighbour at the ends).
class NoiseModel {
 public:
  // Throws std::invalid_argument for a gain <= 0, a negative read noise or a NaN.
  NoiseModel(const SensorNoise& sensor, const RawFrame& frame);
  // phase: the index in CfaPattern::phase.
  double variance_counts2(std::uint16_t value_counts, int phase) const {
    return table_[static_cast<std::size_t>(phase)][value_counts];
  }

 private:
  std::array<std::vector<float>, 4> table_;  // for each phase, 65536 values
};

}  // namespace scattermeter::capture
