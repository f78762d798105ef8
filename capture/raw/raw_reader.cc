#include "capture/raw/raw_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string_view>

#include <libraw/libraw.h>

#include "capture/files/file_text.h"
#include "capture/files/picture_claim.h"
#include "capture/raw/curve_levels.h"
#include "capture/raw/refused_make.h"
#include "capture/raw/tiff_layout.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

constexpr const char* kNoBayer = "has no 2 x 2 red-green-blue colour filter array: ";

std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

void check_is_plain_file(const std::string& path) {
  require_file(path, "a raw file is expected");
  std::error_code error;
  if (std::filesystem::is_regular_file(path, error) &&
      std::filesystem::file_size(path, error) == 0) {
    throw InputError(path, "is empty (0 bytes), a raw file is expected");
  }
  if (!std::ifstream(path)) throw InputError(path, "cannot be opened for reading");
}

void check_opened(const std::string& path, int status) {
  if (status == LIBRAW_SUCCESS) return;
  std::ifstream file(path, std::ios::binary);
  // A TIFF may be a raw file of an unknown camera.
  if (const std::string kind = picture_kind(file); !kind.empty() && kind != "TIFF") {
    throw InputError(path, "is a " + kind +
                               " picture, a raw file is needed: set the camera to raw "
                               "(NEF, CR2, DNG ...) and give these files");
  }
  // LibRaw reports an input/output error for a short text file.
  if (status == LIBRAW_FILE_UNSUPPORTED || status == LIBRAW_IO_ERROR) {
    throw InputError(path, "is no raw file of a known camera format, or truncated in its header");
  }
  throw InputError(path,
                   std::string("cannot be opened as a raw file: ") + LibRaw::strerror(status));
}

void check_unpacked(const std::string& path, int status) {
  if (status == LIBRAW_SUCCESS) return;
  if (status == LIBRAW_IO_ERROR) {
    throw InputError(path, "is truncated: the file ends before its samples do");
  }
  throw InputError(path, std::string("its samples cannot be decoded: ") + LibRaw::strerror(status));
}

// Refuses files without a Bayer pattern before memory is allocated for samples.
void check_is_bayer(const std::string& path, LibRaw& raw) {
  const libraw_iparams_t& image = raw.imgdata.idata;
  const auto refuse = [&](const std::string& what) { throw InputError(path, kNoBayer + what); };
  if (image.is_foveon != 0) refuse("Foveon, three colours at every pixel");
  if (raw.is_sraw() != 0 || raw.is_nikon_sraw() != 0) refuse("YCbCr (small raw)");
  if (image.colors == 1) refuse("monochrome, or no CFAPattern");
  if (image.filters == LIBRAW_XTRANS) refuse("X-Trans, 6 x 6");
  if (image.filters == 0) refuse("full colour at every pixel");
  if (image.filters < 1000) refuse("pattern code " + std::to_string(image.filters));
  if (image.colors != 3) refuse(std::to_string(image.colors) + " colours");
  if (raw.is_fuji_rotated() != 0) refuse("grid rotated by 45 degrees");
  if (raw.is_floating_point() != 0) throw InputError(path, "holds floating-point samples");
  // The bits of `filters` describe 8 rows of 2 columns.
  for (int row = 2; row < 8; ++row) {
    for (int column = 0; column < 2; ++column) {
      if (raw.COLOR(row, column) != raw.COLOR(row % 2, column)) refuse("the pattern has more rows");
    }
  }
}

void check_size(const std::string& path, const libraw_image_sizes_t& sizes, double max_megapixels) {
  const double megapixels = 1e-6 * sizes.raw_width * sizes.raw_height;
  const std::string size =
      std::to_string(sizes.raw_width) + " x " + std::to_string(sizes.raw_height) + " samples";
  if (!(megapixels <= max_megapixels)) {
    throw InputError(path, "claims " + size + ", more than the allowed " + text_of(max_megapixels) +
                               " megapixels (limits.raw_megapixels of the rig)");
  }
  if (sizes.width == 0 || sizes.height == 0 || sizes.left_margin + sizes.width > sizes.raw_width ||
      sizes.top_margin + sizes.height > sizes.raw_height) {
    throw InputError(path, "its active area of " + std::to_string(sizes.width) + " x " +
                               std::to_string(sizes.height) + " does not lie inside its " + size);
  }
}

// The pattern at the first sample of the active area, from which LibRaw's `filters` is counted.
CfaPattern cfa_of(const std::string& path, LibRaw& raw) {
  CfaPattern cfa;
  std::array<int, kChannels> met{};
  for (int phase = 0; phase < 4; ++phase) {
    const char name = raw.imgdata.idata.cdesc[raw.COLOR(phase / 2, phase % 2)];
    const std::string_view names = "RGB";
    const auto channel = names.find(name);
    if (channel == std::string_view::npos) {
      throw InputError(path, std::string(kNoBayer) + "colour '" + name + "'");
    }
    cfa.phase[static_cast<std::size_t>(phase)] = static_cast<Channel>(channel);
    ++met[channel];
  }
  if (met != std::array<int, kChannels>{1, 2, 1}) {
    throw InputError(path, kNoBayer + std::string("its pattern is ") + cfa_pattern_name(cfa));
  }
  return cfa;
}

// LibRaw truncates the fractional black levels of a DNG to integers and stores the exact values
// separately. These are used if the integers agree with them (and do not come from masked borders).
double with_fraction(unsigned counts, float dng_counts) {
  return std::floor(dng_counts) == static_cast<float>(counts) ? dng_counts : counts;
}

// LibRaw's black level is the sum of a common value, one per colour (the second green is separate),
// and a pattern of cblack[4] rows by cblack[5] columns that repeats from the corner of the active
// area. A pattern larger than 2 x 2 is averaged for each phase.
std::array<double, 4> black_of(LibRaw& raw, const TiffLayout& layout) {
  const libraw_colordata_t& color = raw.imgdata.color;
  const auto rows = static_cast<int>(color.cblack[4]);
  const auto columns = static_cast<int>(color.cblack[5]);
  int shift_x = 0;
  int shift_y = 0;
  if (layout.is_dng) {
    shift_x = (raw.imgdata.sizes.left_margin - layout.active_corner_px[0]) & 1;
    shift_y = (raw.imgdata.sizes.top_margin - layout.active_corner_px[1]) & 1;
  }
  std::array<double, 4> black{};
  for (int phase = 0; phase < 4; ++phase) {
    double pattern_sum = 0;
    int places = 0;
    for (int y = phase / 2; y < 2 * rows; y += 2) {
      for (int x = phase % 2; x < 2 * columns; x += 2, ++places) {
        const int at = 6 + (y + shift_y) % rows * columns + (x + shift_x) % columns;
        pattern_sum += with_fraction(color.cblack[at], color.dng_levels.dng_fcblack[at]);
      }
    }
    black[static_cast<std::size_t>(phase)] =
        with_fraction(color.black, color.dng_levels.dng_fblack) +
        color.cblack[raw.COLOR(phase / 2, phase % 2)] + (places > 0 ? pattern_sum / places : 0.0);
  }
  return black;
}

std::vector<std::uint16_t> active_samples(const libraw_data_t& data) {
  const libraw_image_sizes_t& sizes = data.sizes;
  const std::size_t stride = sizes.raw_pitch / sizeof(std::uint16_t);
  std::vector<std::uint16_t> samples;
  samples.reserve(std::size_t{sizes.width} * sizes.height);
  for (std::size_t y = 0; y < sizes.height; ++y) {
    const std::uint16_t* row =
        data.rawdata.raw_image + (y + sizes.top_margin) * stride + sizes.left_margin;
    samples.insert(samples.end(), row, row + sizes.width);
  }
  return samples;
}

// The shortest decimal that rounds to the float in which LibRaw stores a number. It equals the
// number in the file if that has at most six digits: 0.1 s is read as 0.1 and not as 0.100000001.
double from_float(float value) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double result = 0;
  std::from_chars(text.data(), end, result);
  return std::isfinite(result) && result > 0 ? result : 0.0;
}

}  // namespace

RawFrame read_raw(const std::string& path, double max_megapixels) {
  check_is_plain_file(path);
  refuse_unsafe_make(path);
  // LibRaw takes some hundred kilobytes, too much for the stack. Its default callbacks would print.
  const auto raw = std::make_unique<LibRaw>(LIBRAW_OPIONS_NO_MEMERR_CALLBACK |
                                            LIBRAW_OPIONS_NO_DATAERR_CALLBACK);
  check_opened(path, raw->open_file(path.c_str()));
  check_is_bayer(path, *raw);
  check_size(path, raw->imgdata.sizes, max_megapixels);
  const TiffLayout layout = tiff_layout(path);
  if (!layout.problem.empty()) throw InputError(path, layout.problem);
  // Raises LibRaw's own limit, in megabytes; the size was checked above.
  raw->imgdata.params.max_raw_memory_mb =
      std::max(2048U, static_cast<unsigned>(std::min(max_megapixels, 1e6)) * 4U);
  check_unpacked(path, raw->unpack());
  if (raw->error_count() != 0) {
    throw InputError(path, "is damaged or truncated: not all of its samples can be decoded");
  }
  const libraw_data_t& data = raw->imgdata;
  if (data.rawdata.raw_image == nullptr) {
    throw InputError(path, std::string(kNoBayer) + "decoded to several colours at every pixel");
  }
  if (data.rawdata.ph1_cblack != nullptr || data.rawdata.ph1_rblack != nullptr) {
    throw InputError(path, "has a black level per row and column, which is not supported");
  }

  RawFrame frame;
  frame.width_px = data.sizes.width;
  frame.height_px = data.sizes.height;
  frame.left_margin_px = data.sizes.left_margin;
  frame.top_margin_px = data.sizes.top_margin;
  frame.samples = active_samples(data);
  frame.cfa = cfa_of(path, *raw);
  frame.black_counts = black_of(*raw, layout);
  frame.white_counts = data.color.maximum;
  const unsigned bits = data.color.raw_bps;  // of a stored code; 0: unknown
  frame.curve_levels =
      curve_levels(data.color.curve, bits == 0 ? 16 : static_cast<int>(bits), frame.samples);
  frame.exposure_s = from_float(data.other.shutter);
  frame.iso = from_float(data.other.iso_speed);
  frame.f_number = from_float(data.other.aperture);
  frame.make = data.idata.make;
  frame.model = data.idata.model;
  return frame;
}

std::string writer_of_raw(const std::string& path) {
  const auto raw = std::make_unique<LibRaw>();
  return raw->open_file(path.c_str()) == LIBRAW_SUCCESS ? raw->imgdata.idata.software : "";
}

}  // namespace scattermeter::capture
