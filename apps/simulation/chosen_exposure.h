// The exposure time of a simulated shot for which the rig states none.
#pragma once

#include <cmath>
#include <string>

namespace scattermeter::apps {

// For shots whose brightness does not depend on the time, as the rig has no responsivity.
inline constexpr double kDefaultExposure_s = 0.1;

// Level of the brightest sample, as a share of the sensor's range.
inline constexpr double kExposedTo = 0.75;

// A time rounded down to two significant digits. Precondition: exact_s > 0 and finite.
inline double rounded_exposure_s(double exact_s) {
  const double unit_s = std::pow(10.0, std::floor(std::log10(exact_s)) - 1.0);
  // The margin keeps what has two digits already.
  return std::floor(exact_s / unit_s * (1.0 + 1e-9)) * unit_s;
}

// The same for shots to be written. Throws InputError, naming the rig, for a time that no raw file
// holds.
double full_exposure_s(const std::string& rig_path, double exact_s);

}  // namespace scattermeter::apps
