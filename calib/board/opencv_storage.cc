#include "calib/board/opencv_storage.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "capture/files/file_text.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

// OpenCV 4.6 never returns from some texts with more than one document start marker.
bool has_one_document(const std::string& text) {
  int begins = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.compare(0, 3, "---") != 0) continue;
    ++begins;
    if (line.find_first_not_of(" \t\r", 3) != std::string::npos) return false;
  }
  return begins <= 1;
}

// The first line that is not blank.
std::string first_line(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return text.substr(begin, std::min(kLongest, text.find_first_of("\r\n", begin) - begin));
}

cv::FileStorage parse_storage(const std::string& path, const std::string& text) {
  const std::string expected =
      "expected YAML (%YAML), XML or JSON as OpenCV's FileStorage writes it";
  // FileStorage recognises the format by the first characters and fails an assertion on an empty
  // text.
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(path, expected + ", got an empty file");
  }
  if (!has_one_document(text)) {
    throw InputError(path, "expected one document: one line of --- and nothing else in that line");
  }
  try {
    cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
    if (storage.isOpened() && storage.root().isMap()) return storage;
  } catch (const cv::Exception&) {
  } catch (const std::logic_error&) {
    // On some damaged lines its parser gets a negative number of characters.
  }
  throw InputError(path, expected + ", got a file that begins with: " + first_line(text));
}

}  // namespace

cv::FileStorage open_storage(const std::string& path) {
  return parse_storage(path,
                       capture::file_text(path, "the file of a camera's intrinsics is expected"));
}

cv::Mat read_storage_matrix(const std::string& where, const cv::FileNode& node) {
  cv::Mat matrix;
  try {
    if (!node.isMap()) throw InputError(where, "expected an opencv-matrix");
    // OpenCV allocates the memory for the claimed rows and columns before it looks at the values.
    const cv::FileNode rows = node["rows"];
    const cv::FileNode columns = node["cols"];
    const std::size_t values = node["data"].size();
    if (!rows.isInt() || !columns.isInt() || static_cast<int>(rows) < 0 ||
        static_cast<int>(columns) < 0 ||
        static_cast<double>(rows) * static_cast<double>(columns) != static_cast<double>(values)) {
      throw InputError(where,
                       "expected an opencv-matrix of rows x cols values in data, which has " +
                           std::to_string(values));
    }
    node >> matrix;
    if (matrix.dims > 2 || matrix.channels() != 1) {
      throw InputError(where, "expected an opencv-matrix of one channel");
    }
    matrix.convertTo(matrix, CV_64F);
  } catch (const cv::Exception& error) {
    throw InputError(where, "cannot be read as an opencv-matrix: " + error.err);
  }
  return matrix;
}

}  // namespace scattermeter::calib
