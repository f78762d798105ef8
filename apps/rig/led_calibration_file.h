// The file that `calibrate led` writes and a rig's light names as its calibration.
#pragma once

#include <array>
#include <string>

#include "calib/led/led_calibration.h"
#include "core/light/led.h"
#include "core/light/led_uncertainty.h"

namespace scattermeter::apps {

// YAML: the LED (position_mm, axis, exponent, radius_mm, intensity_W_per_sr and the responsivity
// they count for), axis_tangents, covariance (9 x 9, order of core/light/led_uncertainty.h), its
// part common to LEDs of the same plane, ambient light where it was fitted, residuals of every
// highlight. Precondition: the fit is ok. std::invalid_argument otherwise.
std::string led_calibration_yaml(const calib::LedCalibration& calibration);

struct CalibratedLed {
  Led led;
  LedUncertainty uncertainty;
  // Counts mm^2 sr / (W s) that the intensities count for: only the product matters.
  std::array<double, 3> responsivity{};
};

// Throws InputError with file, line, field and value.
CalibratedLed read_led_calibration_file(const std::string& path);

}  // namespace scattermeter::apps
