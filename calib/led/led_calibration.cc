#include "calib/led/led_calibration.h"

#include <cmath>
#include <string>

#include "calib/led/led_mistakes.h"
#include "calib/led/led_verdict.h"

namespace scattermeter::calib {

LedCalibration calibrate_led(const LedCalibrationInput& input, const std::string& light,
                             const LedFrames& frames) {
  LedCalibration out;
  out.light = light;
  out.shots = read_led_shots(input, light, frames);
  const PriorLed& prior = input.led(light);
  LedFitOptions options;
  options.ambient = input.shots.ambient;
  const LedVector variance = uncertainty_of(prior).covariance.diagonal();
  options.axis_std_rad = std::sqrt(variance.segment<2>(kLedAxis).maxCoeff());
  options.exponent_std = std::sqrt(variance[kLedExponent]);
  options.log_intensity_std = std::sqrt(variance.segment<3>(kLedLogIntensity).maxCoeff());
  out.fit = fit_led(out.shots.scene, prior.led, options);
  const std::string mistake = likely_mistake(input, light, frames, out.shots, out.fit, options);
  if (!mistake.empty()) refuse_led(out.fit, LedStatus::kMisfit, mistake);
  out.radiance_corrected = input.correction.has_value();
  return out;
}

}  // namespace scattermeter::calib
