// Calibration of a lens from the shots of a board.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/board/calibration_board.h"
#include "calib/lens/camera_calibration.h"

namespace scattermeter::calib {

struct CalibrateCameraOptions {
  std::vector<std::string> shots;  // one folder, or the files themselves
  CalibrationBoard board;
  double board_std_mm = 0;         // standard deviation of each coordinate of a printed corner
  std::optional<LensModel> model;  // absent: chosen by cross-validation
  double max_megapixels = 400;     // limit on the pixels that a shot may claim
  std::string camera;              // name of the camera that took the shots; "": any
  int width_px = 0;                // of the camera's frame; 0: the size of most of the shots
  int height_px = 0;
};

struct CameraCalibrationRun {
  CameraCalibration calibration;
  std::size_t n_shots = 0;
};

// Reads the shots (raws or pictures), finds the board and calibrates
// (calib/lens/camera_calibration.h). Shots of another size or camera, and files in a folder that
// are not pictures, are left out and listed in CameraCalibration::left_out. Throws InputError for a
// listed file that cannot be read or is given twice, and for a folder that is empty or contains no
// picture.
CameraCalibrationRun calibrate_camera_shots(const CalibrateCameraOptions& options);

}  // namespace scattermeter::calib
