// `calibrate camera`: shots of a board in, a lens out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calib/calibration_board.h"
#include "calib/camera_calibration.h"

namespace scattermeter::apps {

struct CalibrateCameraOptions {
  std::vector<std::string> shots;         // one folder, or files; with a rig: its folder of shots
  std::string rig;                        // "": none; else board, shots and frame are the rig's
  calib::CalibrationBoard board;          // without a rig
  double board_std_mm = 0;                // without a rig
  std::optional<calib::LensModel> model;  // absent: by cross-validation
  double max_megapixels = 400;            // that a shot may claim; with a rig: its limits
  std::string out;                        // the file to write
  std::string command_line;               // for the file's head
};

struct CameraCalibrationRun {
  calib::CalibrationBoard board;
  calib::CameraCalibration calibration;
  std::size_t n_shots = 0;
  std::vector<std::string> written;  // paths; empty where the calibration is refused
  std::vector<std::string> notes;    // for the user, such as a picture that was not drawn
};

// Reads the shots (raws or pictures), finds the board, calibrates (calib/camera_calibration.h),
// writes `out` (calib/camera_calibration_file.h) and beside it, with the same stem,
// *_residuals.png and *_coverage.png. Shots of another size than most (with a rig: than the rig's)
// or another camera model, and files of a folder that hold no picture, are left out and named;
// a file that was named and cannot be read is InputError, as is all else that is bad input.
// A refused calibration (status) writes nothing.
CameraCalibrationRun calibrate_camera_shots(const CalibrateCameraOptions& options);

// The report for the terminal.
std::string camera_calibration_table(const CameraCalibrationRun& run);

}  // namespace scattermeter::apps
