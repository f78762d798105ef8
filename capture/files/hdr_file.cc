#include "capture/files/hdr_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <vector>

#include "core/base/input_error.h"

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
  bool has_format = false;
  while (next_line(line) && !line.empty()) {
    if (!line.starts_with("FORMAT=")) continue;
    has_format = true;
    if (line != "FORMAT=32-bit_rle_rgbe") {
      throw InputError(path, line + " is not read, only 32-bit_rle_rgbe");
    }
  }
  if (!has_format) throw InputError(path, "its header names no FORMAT");
  if (!next_line(line)) throw InputError(path, "is truncated in its header");
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

// Four bytes of a pixel: mantissas of R, G, B over 256 and their common exponent, 128 more than it
// is; exponent byte 0 is black (G. Ward, Real Pixels, Graphics Gems II, 1991).
void append_pixel(const std::uint8_t* rgbe, std::vector<float>* radiance) {
  const float unit = rgbe[3] == 0 ? 0.0F : std::ldexp(1.0F, rgbe[3] - (128 + 8));
  for (int c = 0; c < 3; ++c) radiance->push_back(unit * static_cast<float>(rgbe[c]));
}

// Decodes one row of runs and literals from byte `at` on, the four channels one after the other in
// `row`. Returns false if it is truncated or damaged; `at` then lies somewhere within it.
bool decode_runs(const std::string& bytes, std::size_t width, std::size_t& at,
                 std::vector<std::uint8_t>* row) {
  row->clear();
  for (std::size_t end = width; end <= 4 * width; end += width) {
    while (row->size() < end) {
      if (at >= bytes.size()) return false;
      const std::size_t code = static_cast<std::uint8_t>(bytes[at++]);
      const bool run = code > 128;
      const std::size_t count = run ? code - 128 : code;
      if (count == 0 || row->size() + count > end || bytes.size() - at < (run ? 1 : count)) {
        return false;
      }
      if (run) {
        row->insert(row->end(), count, static_cast<std::uint8_t>(bytes[at++]));
      } else {
        const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        row->insert(row->end(), first, first + static_cast<std::ptrdiff_t>(count));
        at += count;
      }
    }
  }
  return true;
}

// Decodes the pixels from byte `at` on. Returns false if they are truncated or damaged.
bool decode_pixels(const std::string& bytes, std::size_t at, const Header& header,
                   std::vector<float>* radiance) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); };
  const auto width = static_cast<std::size_t>(header.width);
  std::vector<std::uint8_t> row;
  for (int y = 0; y < header.height; ++y) {
    const bool run_length = width >= 8 && width < 32768 && at + 4 <= bytes.size() &&
                            byte(at) == 2 && byte(at + 1) == 2 && (byte(at + 2) & 0x80) == 0;
    if (!run_length) {
      // All rows after the first flat one are flat.
      const std::size_t pixels = width * static_cast<std::size_t>(header.height - y);
      if ((bytes.size() - at) / 4 < pixels) return false;
      for (std::size_t i = 0; i < pixels; ++i, at += 4) {
        append_pixel(std::array{byte(at), byte(at + 1), byte(at + 2), byte(at + 3)}.data(),
                     radiance);
      }
      return true;
    }
    if (static_cast<std::size_t>(byte(at + 2)) * 256 + byte(at + 3) != width) return false;
    at += 4;
    if (!decode_runs(bytes, width, at, &row)) return false;
    for (std::size_t x = 0; x < width; ++x) {
      append_pixel(
          std::array{row[x], row[width + x], row[2 * width + x], row[3 * width + x]}.data(),
          radiance);
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
                               " are allowed (limits.probe_megapixels of the rig)");
  }
  ProbeImage probe{header.width, header.height, {}};
  // No byte of a file encodes more than 127 pixels.
  probe.radiance.reserve(3 * std::min(pixels, 127 * bytes.size()));
  if (!decode_pixels(bytes, header.size, header, &probe.radiance)) {
    throw InputError(path, "is truncated or damaged in its pixels");
  }
  return probe;
}

}  // namespace scattermeter::capture
