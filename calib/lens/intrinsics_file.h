// Reading of camera intrinsics from files in the format of OpenCV's FileStorage.
#pragma once

#include <string>

#include "core/camera/camera_model.h"

namespace scattermeter::calib {

// Reads from a YAML, XML or JSON file: a 3 x 3 matrix camera_matrix, cameraMatrix or K (last row 0
// 0 1, no skew); distortion_coefficients, distCoeffs or D (one row or column; none means no
// distortion; trailing zeros beyond 8 terms are dropped, other terms refused); image_width and
// image_height, or image_size (two integers). The image size is required: a matrix without it
// cannot be checked against the shots. Throws InputError naming file and field. OpenCV's error
// callback, global to the process, is replaced during reading so that nothing is printed, and
// restored before returning.
CameraIntrinsics read_intrinsics(const std::string& path);

}  // namespace scattermeter::calib
