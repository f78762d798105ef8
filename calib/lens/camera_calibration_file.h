// A camera's calibration as a file of OpenCV's FileStorage.
#pragma once

#include <string>
#include <vector>

#include "calib/lens/camera_calibration.h"

namespace scattermeter::calib {

// YAML text with what OpenCV's own samples write and calib::read_intrinsics() reads:
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
// Comment lines at its head, one each (no line breaks). Precondition: kOk
// (std::invalid_argument).
std::string camera_calibration_text(const CameraCalibration& calibration,
                                    const std::vector<std::string>& comments);

// What such a file holds of a calibration. Read back to the last digit; candidates, what else was
// left out, and layout are for people and not read.
struct CameraCalibrationFile {
  CameraIntrinsics intrinsics;
  // From here on empty or 0 in a file that OpenCV wrote.
  std::vector<std::string> parameters;  // names, see parameter_names()
  Eigen::MatrixXd covariance;
  double rms_px = 0;
  double worst_px = 0;
  double noise_std_px = 0;
  std::vector<std::string> views;
  std::vector<CornerResidual> residuals;
};

// Reads any file that read_intrinsics() does, and the rest where it is there. Throws InputError
// naming file and field: a covariance that does not belong to its parameters, is not symmetric to
// 1e-9 or not positive, residuals of no view.
CameraCalibrationFile read_camera_calibration_file(const std::string& path);

}  // namespace scattermeter::calib
