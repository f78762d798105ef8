// Reading of files in the format of OpenCV's FileStorage. For the .cc files of calib only, as it
// exposes OpenCV's types.
#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace scattermeter::calib {

// Opens a YAML, XML or JSON file whose top level is a map. Throws InputError naming the file. The
// caller must have an OpencvQuiet, since cv::FileStorage also logs to stderr what it throws.
cv::FileStorage open_storage(const std::string& path);

// A single-channel, two-dimensional opencv-matrix, converted to double. Throws InputError with
// `where`.
cv::Mat read_storage_matrix(const std::string& where, const cv::FileNode& node);

}  // namespace scattermeter::calib
