// The input of a radiance calibration besides the frames.
#pragma once

#include <optional>

#include "calib/led/prior_led.h"
#include "calib/pose/frame_pose.h"
#include "calib/radiance/radiance_calibration_shots.h"
#include "core/camera/camera_model.h"

namespace scattermeter::calib {

struct RadianceCalibrationInput {
  RadianceCalibrationShots shots;
  // For shots.white only: the LED over the white reference, and the camera that sees it.
  std::optional<PriorLed> white_led;
  CameraIntrinsics intrinsics;
  FramePose pose;
};

}  // namespace scattermeter::calib
