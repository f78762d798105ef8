#include "capture/hdr_file.h"

#include <cstdint>
#include <sstream>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/input_error.h"

namespace scattermeter::capture {
namespace {

struct Header {
  int width = 0;
  int height = 0;
  std::size_t size = 0;  // bytes
};

Header read_header(const std::string& path, const std::string& bytes) {
  std::size_t at = 0;
  const auto next_line = [&](std::string& line) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string::npos) return false;
    line = bytes.substr(at, end - at);
    at = end + 1;
    return true;
  };
  std::string line;
  while (next_line(line) && !line.empty()) {
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe") {
      throw InputError(path, line + " is not read, only 32-bit_rle_rgbe");
    }
  }
  if (!next_line(line)) throw InputError(path, "is cut short in its header");
  std::istringstream size(line);
  std::string minus_y;
  std::string plus_x;
  long long height = 0;
  long long width = 0;
  size >> minus_y >> height >> plus_x >> width;
  if (!size || minus_y != "-Y" || plus_x != "+X" || height < 1 || width < 1 || height > 1'000'000 ||
      width > 1'000'000) {
    throw InputError(path, "the picture's size is \"" + line.substr(0, 60) +
                               "\", expected \"-Y height +X width\"");
  }
  return {static_cast<int>(width), static_cast<int>(height), at};
}

// Whether the pixels from byte `at` on are all there. (The decoder leaves rows that are missing as
// they come, or says so on its own.)
bool complete(const std::string& bytes, std::size_t at, const Header& header) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  const auto width = static_cast<std::size_t>(header.width);
  for (int y = 0; y < header.height; ++y) {
    const bool run_length = width >= 8 && width < 32768 && at + 4 <= bytes.size() &&
                            byte(at) == 2 && byte(at + 1) == 2 && (byte(at + 2) & 0x80) == 0;
    if (!run_length) {
      // From the first flat row on, all are flat.
      const std::size_t rows = static_cast<std::size_t>(header.height - y);
      return bytes.size() - at >= 4 * width * rows;
    }
    if (static_cast<std::size_t>(byte(at + 2)) * 256 + byte(at + 3) != width) return false;
    at += 4;
    for (int channel = 0; channel < 4; ++channel) {
      for (std::size_t x = 0; x < width;) {
        if (at >= bytes.size()) return false;
        const std::size_t code = byte(at);
        const std::size_t count = code > 128 ? code - 128 : code;
        at += code > 128 ? 2 : 1 + code;
        x += count;
        if (count == 0 || x > width || at > bytes.size()) return false;
      }
    }
  }
  return true;
}

}  // namespace

bool is_hdr(const std::string& bytes) {
  return bytes.starts_with("#?RADIANCE") || bytes.starts_with("#?RGBE");
}

ProbeImage decode_hdr(const std::string& path, const std::string& bytes,
                      const ProbeLimits& limits) {
  const Header header = read_header(path, bytes);
  const std::size_t pixels =
      static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
  if (pixels > limits.max_pixels) {
    throw InputError(path, "is " + std::to_string(header.width) + " x " +
                               std::to_string(header.height) + " pixels, at most " +
                               std::to_string(limits.max_pixels) +
                               " are read (limits.probe_megapixels of the rig)");
  }
  if (!complete(bytes, header.size, header)) {
    throw InputError(path, "is cut short or damaged in its pixels");
  }
  cv::Mat image;
  try {
    const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8U,
                         const_cast<char*>(bytes.data()));  // NOLINT: OpenCV's Mat is not const
    image = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& e) {
    throw InputError(path, "cannot be decoded: " + e.err);
  }
  if (image.cols != header.width || image.rows != header.height || image.type() != CV_32FC3) {
    throw InputError(path, "cannot be decoded");
  }
  ProbeImage probe{header.width, header.height, {}};
  probe.radiance.reserve(3 * pixels);
  for (int y = 0; y < image.rows; ++y) {
    const auto* row = image.ptr<cv::Vec3f>(y);
    for (int x = 0; x < image.cols; ++x) {
      for (int c : {2, 1, 0}) probe.radiance.push_back(row[x][c]);  // stored B G R
    }
  }
  return probe;
}

}  // namespace scattermeter::capture
