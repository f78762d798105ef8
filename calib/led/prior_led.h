// An LED as known before its calibration.
#pragma once

#include <optional>
#include <string>

#include "core/light/led.h"
#include "core/light/led_uncertainty.h"

namespace scattermeter::calib {

struct PriorLed {
  std::string name;
  Led led;
  double position_std_mm = 0;  // of each coordinate
  double exponent_std = 0;
  double power_relative_std = 0;  // common to the three channels
  // From an earlier calibration; replaces the three standard deviations above.
  std::optional<LedUncertainty> calibrated;
};

}  // namespace scattermeter::calib
