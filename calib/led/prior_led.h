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
  double axis_std_rad = 0;
  double exponent_std = 0;
  double power_relative_std = 0;  // common to the three channels
  // From an earlier calibration; replaces the standard deviations above.
  std::optional<LedUncertainty> calibrated;
};

// Of the calibration, or else what its standard deviations say, without correlations.
LedUncertainty uncertainty_of(const PriorLed& prior);

}  // namespace scattermeter::calib
