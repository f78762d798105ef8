#include "calib/lens/intrinsics_file.h"

#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "calib/board/opencv_quiet.h"
#include "calib/board/opencv_storage.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

using Names = std::initializer_list<const char*>;

// The first of `names` that is present.
std::optional<std::pair<std::string, cv::FileNode>> find(const cv::FileStorage& storage,
                                                         Names names) {
  for (const char* name : names) {
    const cv::FileNode node = storage[name];
    if (!node.empty()) return std::make_pair(std::string(name), node);
  }
  return std::nullopt;
}

std::string list(Names names) {
  std::string out;
  for (const char* name : names) out += (out.empty() ? "" : " or ") + std::string(name);
  return out;
}

void read_camera_matrix(const std::string& path, const cv::FileStorage& storage,
                        CameraIntrinsics* intrinsics) {
  const Names names = {"camera_matrix", "cameraMatrix", "K"};
  const auto found = find(storage, names);
  if (!found) throw InputError(path, "has no " + list(names));
  const std::string where = path + ": " + found->first;
  const cv::Mat k = read_storage_matrix(where, found->second);
  std::ostringstream out;
  if (k.rows != 3 || k.cols != 3) {
    out << "expected a 3 x 3 matrix, got " << k.rows << " x " << k.cols;
    throw InputError(where, out.str());
  }
  const cv::Mat_<double> m(k);
  for (const auto& [row, column, expected] :
       {std::tuple(0, 1, 0.0), {1, 0, 0.0}, {2, 0, 0.0}, {2, 1, 0.0}, {2, 2, 1.0}}) {
    const double value = m(row, column);
    if (value == expected) continue;
    out << "expected " << expected << " in row " << row + 1 << ", column " << column + 1
        << " (pixels without skew), got " << value;
    throw InputError(where, out.str());
  }
  intrinsics->fx_px = m(0, 0);
  intrinsics->fy_px = m(1, 1);
  intrinsics->cx_px = m(0, 2);
  intrinsics->cy_px = m(1, 2);
}

void read_distortion(const std::string& path, const cv::FileStorage& storage,
                     CameraIntrinsics* intrinsics) {
  const auto found = find(storage, {"distortion_coefficients", "distCoeffs", "D"});
  if (!found) return;
  const std::string where = path + ": " + found->first;
  const cv::Mat d = read_storage_matrix(where, found->second);
  std::ostringstream out;
  if (!d.empty() && d.rows != 1 && d.cols != 1) {
    out << "expected one row or one column, got " << d.rows << " x " << d.cols;
    throw InputError(where, out.str());
  }
  std::vector<double> terms(d.begin<double>(), d.end<double>());
  // Thin-prism and tilt terms, which OpenCV writes as zeros if they were not fitted.
  while (terms.size() > 8 && terms.back() == 0) terms.pop_back();
  if (const size_t n = terms.size(); n != 0 && n != 4 && n != 5 && n != 8) {
    out << "expected 0, 4, 5 or 8 terms (k1 k2 p1 p2 [k3 [k4 k5 k6]]; thin prism and tilt are not "
        << "modelled), got " << n;
    throw InputError(where, out.str());
  }
  intrinsics->distortion = std::move(terms);
}

int read_size(const std::string& where, const cv::FileNode& node) {
  const double value = node.isReal() || node.isInt() ? static_cast<double>(node) : 0;
  if (value >= 1 && value <= 1e6 && value == std::floor(value)) return static_cast<int>(value);
  std::ostringstream out;
  out << "expected a positive whole number of pixels, got ";
  if (node.isReal() || node.isInt()) {
    out << value;
  } else if (node.isString()) {
    out << '"' << static_cast<std::string>(node) << '"';
  } else {
    out << "something else";
  }
  throw InputError(where, out.str());
}

void read_image_size(const std::string& path, const cv::FileStorage& storage,
                     CameraIntrinsics* intrinsics) {
  const cv::FileNode both = storage["image_size"];
  if (!both.empty()) {
    const std::string where = path + ": image_size";
    if (!both.isSeq() || both.size() != 2) {
      throw InputError(where, "expected two positive integers [width, height]");
    }
    intrinsics->width_px = read_size(where, both[0]);
    intrinsics->height_px = read_size(where, both[1]);
    return;
  }
  for (const auto& [name, value] : {std::pair("image_width", &intrinsics->width_px),
                                    {"image_height", &intrinsics->height_px}}) {
    const cv::FileNode node = storage[name];
    if (node.empty()) {
      throw InputError(path,
                       std::string("has no ") + name +
                           " (image_width and image_height, or image_size, are needed to check "
                           "the shots against)");
    }
    *value = read_size(path + ": " + name, node);
  }
}

}  // namespace

CameraIntrinsics read_intrinsics(const std::string& path) {
  const OpencvQuiet quiet;
  CameraIntrinsics intrinsics;
  try {
    const cv::FileStorage storage = open_storage(path);
    read_camera_matrix(path, storage, &intrinsics);
    read_distortion(path, storage, &intrinsics);
    read_image_size(path, storage, &intrinsics);
  } catch (const cv::Exception& error) {
    throw InputError(path, "cannot be read: " + error.err);
  }
  if (const std::string problem = intrinsics_problem(intrinsics); !problem.empty()) {
    throw InputError(path, problem);
  }
  return intrinsics;
}

}  // namespace scattermeter::calib
