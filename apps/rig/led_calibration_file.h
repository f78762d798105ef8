// The file written by `calibrate led` and named by a rig's light as its calibration.
#pragma once

#include <array>
#include <string>

#include "calib/led/led_calibration.h"
#include "core/light/led.h"
#include "core/light/led_uncertainty.h"

namespace scattermeter::apps {

// YAML: the LED (position_mm, axis, exponent, radius_mm, intensity_W_per_sr and the responsivity
// for which it is valid, and whether camera.radiance corrected the shots), axis_tangents,
// covariance (9 x 9, order of core/light/led_uncertainty.h), its part common to LEDs of the same
// plane, ambient light if it was fitted, residuals of every highlight. Throws std::invalid_argument
// unless the fit is ok.
std::string led_calibration_yaml(const calib::LedCalibration& calibration);

struct CalibratedLed {
  Led led;
  LedUncertainty uncertainty;
  // Counts mm^2 sr / (W s) for which the intensities are valid: only the product matters.
  std::optional<std::array<double, 3>> responsivity;  // none: the intensities are the rig's
  std::optional<bool> radiance_corrected;  // none: there is no intensity, or the file does not say
};

// Throws InputError with file, line, field and value.
CalibratedLed read_led_calibration_file(const std::string& path);

}  // namespace scattermeter::apps
