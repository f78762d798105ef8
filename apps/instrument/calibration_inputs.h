// The inputs of the calibrations (calib/) from a rig.
#pragma once

#include <string>

#include "apps/rig/rig.h"
#include "calib/led/led_calibration_input.h"
#include "calib/led/led_shots.h"
#include "calib/lens/calibrate_camera.h"
#include "calib/radiance/calibrate_radiance.h"
#include "calib/radiance/radiance_calibration_input.h"

namespace scattermeter::apps {

// From the rig's calibration.camera, its camera and limits. The rig need not be complete: the file
// of its intrinsics may not exist yet. Throws InputError for a bad rig or a listed shot that is not
// in the folder.
calib::CalibrateCameraOptions camera_calibration_input(const std::string& rig_path,
                                                       const std::string& shots_folder);

// Throws InputError if the rig has no calibration.led. The rig must outlive the result.
calib::LedCalibrationInput led_calibration_input(const Rig& rig);

// Opens the shots of calibration.led as files of a folder. They throw InputError for a file that is
// missing or not a shot of the rig's camera. The rig must outlive the result.
calib::LedFrames led_frames_in(const Rig& rig, const std::string& shots_folder);

// Throws InputError if the rig has no calibration.radiance. The rig must outlive the result.
calib::RadianceCalibrationInput radiance_calibration_input(const Rig& rig);

// Opens the shots of calibration.radiance as files of a folder, with errors as for led_frames_in().
// The rig must outlive the result.
calib::RadianceFrames radiance_frames_in(const Rig& rig, const std::string& shots_folder);

}  // namespace scattermeter::apps
