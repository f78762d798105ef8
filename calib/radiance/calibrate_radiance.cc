#include "calib/radiance/calibrate_radiance.h"

#include <stdexcept>

#include "calib/radiance/radiance_steps.h"

namespace scattermeter::calib {

capture::RadianceCalibration calibrate_radiance(const RadianceCalibrationInput& input,
                                                const RadianceFrames& open) {
  if (input.shots.white && !input.white_led) {
    throw std::invalid_argument("calibrate_radiance: the white reference has no LED");
  }
  capture::RadianceCalibration calibration;
  RadianceSteps steps{input, open, calibration, {}};
  find_dark(steps);
  find_response_and_noise(steps);
  find_glare(steps);
  find_vignetting(steps);
  find_scale(steps);
  return calibration;
}

}  // namespace scattermeter::calib
