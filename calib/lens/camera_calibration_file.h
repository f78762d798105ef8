// Camera calibrations as files in the format of OpenCV's FileStorage.
#pragma once

#include <string>
#include <vector>

#include "calib/lens/camera_calibration.h"

namespace scattermeter::calib {

// YAML text with the fields that OpenCV's own samples write and calib::read_intrinsics() reads:
//   image_width, image_height, camera_matrix, distortion_coefficients (5 or 8),
//   avg_reprojection_error (= rms_px, OpenCV's name);
// and scattermeter_camera: 1 with
//   parameters (names), covariance (P x P, in their units), rms_px, worst_px, noise_std_px,
//   view_scatter, covariance_widened, frame_corner_std_px,
//   widest_angle_rad, covered_share,
//   views (name, corners, rms_px, worst_px), left_out (name, reason),
//   corners_left_out (view, x_px, y_px, distance_px),
//   models (name, rms_px, left_out_rms_px, chosen or why not), warnings,
//   residuals: n x 5: index of the view, found x and y, projected - found x and y, px.
// `comments` become comment lines at the head of the text, one line each (without line breaks).
// Throws std::invalid_argument unless the status is kOk.
std::string camera_calibration_text(const CameraCalibration& calibration,
                                    const std::vector<std::string>& comments);

// The part of a calibration that is read back from such a file, to the last digit. The candidates,
// the lists of what was left out, and the layout are for readers of the file only.
struct CameraCalibrationFile {
  CameraIntrinsics intrinsics;
  // The members below are empty or 0 for a file that OpenCV wrote.
  std::vector<std::string> parameters;  // names, see parameter_names()
  Eigen::MatrixXd covariance;
  double rms_px = 0;
  double worst_px = 0;
  double noise_std_px = 0;
  std::vector<std::string> views;
  std::vector<CornerResidual> residuals;
};

// Reads any file that read_intrinsics() reads, and the other fields if present. Throws InputError
// naming file and field, also for a covariance that does not match its parameters, is not symmetric
// to 1e-9 or not positive, and for residuals of an unknown view.
CameraCalibrationFile read_camera_calibration_file(const std::string& path);

}  // namespace scattermeter::calib
