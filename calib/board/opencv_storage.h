// Files of OpenCV's FileStorage. For calib's own .cc files only: shows OpenCV's types.
#pragma once

#include <string>

#include <opencv2/core.hpp>

namespace scattermeter::calib {

// Opens YAML, XML or JSON whose top is a map. Throws InputError naming the file. Hold an
// OpencvQuiet: cv::FileStorage logs to stderr what it also throws.
cv::FileStorage open_storage(const std::string& path);

// An opencv-matrix of one channel and two dimensions, as doubles. Throws InputError with `where`.
cv::Mat read_storage_matrix(const std::string& where, const cv::FileNode& node);

}  // namespace scattermeter::calib
