// calibrate led: from shots to an LED.
#pragma once

#include <string>

#include "apps/led_shots.h"
#include "apps/rig.h"
#include "calib/led_fit.h"

namespace scattermeter::apps {

struct LedCalibration {
  std::string light;
  LedShots shots;
  calib::LedFit fit;  // its status says whether it is an answer
};

// Throws InputError as read_led_shots() does. The rig's LED is the start; its radius_mm stays.
LedCalibration calibrate_led(const Rig& rig, const std::string& light, const LedFrames& frames);

// Values, deviations and units; residuals. Of a refused one: why.
std::string led_calibration_table(const LedCalibration& calibration);

}  // namespace scattermeter::apps
