// The input of an LED's calibration besides the frames.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "calib/led/led_calibration_shots.h"
#include "calib/led/prior_led.h"
#include "calib/pose/frame_pose.h"
#include "capture/sensor/radiance_correction.h"
#include "core/camera/camera_model.h"
#include "core/camera/sensor_noise.h"

namespace scattermeter::calib {

struct LedCalibrationInput {
  LedCalibrationShots shots;
  std::vector<PriorLed> leds;
  CameraIntrinsics intrinsics;
  FramePose pose;
  // R, G, B; absent: kNominalResponsivity (calib/led/led_shots.h).
  std::optional<std::array<double, 3>> responsivity_counts_mm2_sr_per_W_s;
  SensorNoise noise;  // without a correction
  std::optional<capture::RadianceCorrection> correction;

  // Throws std::out_of_range for a name that is not in `leds`.
  const PriorLed& led(const std::string& name) const;
};

}  // namespace scattermeter::calib
