#include "calib/led/led_calibration_input.h"

#include <algorithm>
#include <stdexcept>

namespace scattermeter::calib {

const PriorLed& LedCalibrationInput::led(const std::string& name) const {
  const auto at = std::find_if(leds.begin(), leds.end(),
                               [&](const PriorLed& prior) { return prior.name == name; });
  if (at == leds.end()) throw std::out_of_range("LedCalibrationInput: no LED named " + name);
  return *at;
}

}  // namespace scattermeter::calib
