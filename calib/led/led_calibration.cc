#include "calib/led/led_calibration.h"

#include <cmath>

namespace scattermeter::calib {

LedCalibration calibrate_led(const LedCalibrationInput& input, const std::string& light,
                             const LedFrames& frames) {
  LedCalibration out;
  out.light = light;
  out.shots = read_led_shots(input, light, frames);
  const PriorLed& prior = input.led(light);
  LedFitOptions options;
  options.ambient = input.shots.ambient;
  options.exponent_std = prior.exponent_std;
  options.log_intensity_std = prior.power_relative_std;
  if (prior.calibrated) {
    const LedMatrix& c = prior.calibrated->covariance;
    options.exponent_std = std::sqrt(c(kLedExponent, kLedExponent));
    options.log_intensity_std = std::sqrt(c.diagonal().segment<3>(kLedLogIntensity).maxCoeff());
  }
  out.fit = fit_led(out.shots.scene, prior.led, options);
  return out;
}

}  // namespace scattermeter::calib
