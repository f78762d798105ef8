// Calibration of an LED from its shots.
#pragma once

#include <string>

#include "calib/led/led_calibration_input.h"
#include "calib/led/led_fit.h"
#include "calib/led/led_shots.h"

namespace scattermeter::calib {

struct LedCalibration {
  std::string light;
  LedShots shots;
  LedFit fit;                       // valid if its status is kOk
  bool radiance_corrected = false;  // whether a calibration of radiance corrected the shots
};

// Applies fit_led() to the result of read_led_shots(), starting from the LED of the input, whose
// radius_mm is kept. Throws InputError as read_led_shots() does.
LedCalibration calibrate_led(const LedCalibrationInput& input, const std::string& light,
                             const LedFrames& frames);

}  // namespace scattermeter::calib
