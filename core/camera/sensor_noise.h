// Noise of a sensor at one ISO setting.
#pragma once

namespace scattermeter {

// The mean squared second difference of neighbouring samples tells their variance without their
// slope. Such triples overlap: one step apart they have a correlation of -4/6, two steps apart of
// 1/6, so n of them determine a variance as well as n over this many independent ones.
inline constexpr double kSecondDifferenceOverlap = 1.0 + 2.0 * (16.0 + 1.0) / 36.0;

// The sensor at the shot's ISO setting.
struct SensorNoise {
  double gain_e_per_count = 6.0;   // electrons per count, > 0
  double read_noise_counts = 1.0;  // standard deviation in the dark, in counts, >= 0
};

}  // namespace scattermeter
