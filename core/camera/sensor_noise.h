// Noise of a sensor at one ISO setting.
#pragma once

namespace scattermeter {

// The sensor at the shot's ISO setting.
struct SensorNoise {
  double gain_e_per_count = 6.0;   // electrons per count, > 0
  double read_noise_counts = 1.0;  // standard deviation in the dark, in counts, >= 0
};

}  // namespace scattermeter
