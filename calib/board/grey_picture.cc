#include "calib/board/grey_picture.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/core.h>
#include <opencv2/imgcodecs.hpp>

#include "calib/board/opencv_quiet.h"
#include "capture/files/file_text.h"
#include "capture/files/picture_claim.h"
#include "capture/raw/raw_reader.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

bool is_ordinary_picture(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static const std::set<std::string> kEndings = {".jpg", ".jpeg", ".png", ".tif", ".tiff",
                                                 ".bmp", ".pgm",  ".ppm", ".webp"};
  return kEndings.contains(ending);
}

// OpenCV itself allocates memory for up to 2^30 pixels and reads more formats than cameras write.
capture::PictureClaim claim_within(const std::string& path, double max_megapixels) {
  capture::require_file(path, "a picture is expected");
  std::ifstream file(path, std::ios::binary);
  const auto claim = capture::picture_claim(file);
  if (!claim) throw InputError(path, "is not a picture, or is damaged");
  if (1e-6 * claim->pixels > max_megapixels) {
    throw InputError(
        path,
        fmt::format(
            "claims {} x {} pixels{}, more than the allowed {} megapixels "
            "(limits.raw_megapixels of the rig, --max-megapixels without one)",
            claim->width_px, claim->height_px,
            claim->pixels > 1.0 * claim->width_px * claim->height_px ? " in larger tiles" : "",
            max_megapixels));
  }
  return *claim;
}

}  // namespace

GreyPicture grey_picture(const capture::RawFrame& frame) {
  std::array<double, 4> mean{};
  for (int y = 0; y + 1 < frame.height_px; y += 2) {
    std::array<long long, 4> sum{};
    for (int x = 0; x + 1 < frame.width_px; x += 2) {
      sum[0] += frame.at(x, y);
      sum[1] += frame.at(x + 1, y);
      sum[2] += frame.at(x, y + 1);
      sum[3] += frame.at(x + 1, y + 1);
    }
    for (std::size_t p = 0; p < 4; ++p) mean[p] += static_cast<double>(sum[p]);
  }
  GreyPicture out;
  out.width_px = frame.width_px / 2;
  out.height_px = frame.height_px / 2;
  std::array<double, 4> weight{};
  for (std::size_t p = 0; p < 4; ++p) {
    mean[p] = mean[p] / out.width_px / out.height_px - frame.black_counts[p];
    weight[p] = mean[p] > 0 ? 1 / mean[p] : 0;
  }
  out.grey.resize(static_cast<std::size_t>(out.width_px) * static_cast<std::size_t>(out.height_px));
  std::size_t i = 0;
  for (int y = 0; y < out.height_px; ++y) {
    for (int x = 0; x < out.width_px; ++x) {
      double sum = 0;
      for (int p = 0; p < 4; ++p) {
        const auto phase = static_cast<std::size_t>(p);
        sum += weight[phase] * (frame.at(2 * x + p % 2, 2 * y + p / 2) - frame.black_counts[phase]);
      }
      out.grey[i++] = static_cast<float>(std::max(0.0, sum));
    }
  }
  out.px_scale = 2;
  out.px_offset = 0.5;
  out.frame_width_px = frame.width_px;
  out.frame_height_px = frame.height_px;
  out.make = frame.make;
  out.model = frame.model;
  return out;
}

GreyPicture read_grey_picture(const std::string& path, double max_megapixels) {
  if (!is_ordinary_picture(path)) return grey_picture(capture::read_raw(path, max_megapixels));
  const capture::PictureClaim claim = claim_within(path, max_megapixels);
  const calib::OpencvQuiet quiet;
  cv::Mat picture;
  try {
    picture = cv::imread(
        path, cv::IMREAD_GRAYSCALE | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const cv::Exception& e) {
    throw InputError(path, "the picture cannot be read: " + e.err);
  }
  if (picture.empty() || static_cast<std::uint32_t>(picture.cols) != claim.width_px ||
      static_cast<std::uint32_t>(picture.rows) != claim.height_px) {
    throw InputError(path, "is not a picture, or is damaged");
  }
  cv::Mat_<float> grey;
  picture.convertTo(grey, CV_32F);
  GreyPicture out;
  out.width_px = out.frame_width_px = grey.cols;
  out.height_px = out.frame_height_px = grey.rows;
  out.grey.assign(grey.begin(), grey.end());
  return out;
}

}  // namespace scattermeter::calib
