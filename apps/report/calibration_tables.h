// Results of calibrations as tables for the terminal.
#pragma once

#include <string>

#include "calib/board/calibration_board.h"
#include "calib/led/led_calibration.h"
#include "calib/lens/calibrate_camera.h"
#include "capture/sensor/radiance_calibration.h"

namespace scattermeter::apps {

// "chess board of 10 x 7 squares of 30 mm"
std::string board_name(const calib::CalibrationBoard& board);

// The excluded views and corners and, for a successful calibration, the values with standard
// deviations and units, the residuals, the lens models compared, and warnings.
std::string camera_calibration_table(const calib::CalibrationBoard& board,
                                     const calib::CameraCalibrationRun& run);

// Values with standard deviations and units, then residuals; the reason if refused.
std::string led_calibration_table(const calib::LedCalibration& calibration);

// A sentence: how well a calibrated LED is known. The deviation of the position is that of the
// distance from the true one (root of the trace).
std::string led_calibration_verdict(const calib::LedCalibration& calibration);

// Value, standard deviation and unit of each result, then residuals and notes.
std::string radiance_calibration_table(const capture::RadianceCalibration& calibration);

}  // namespace scattermeter::apps
