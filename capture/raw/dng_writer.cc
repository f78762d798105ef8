#include "capture/raw/dng_writer.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>

#include <tiffio.h>
#include <unistd.h>

#include "capture/files/pending_file.h"
#include "capture/raw/exif_directory.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

constexpr int kMaxCode = 4095;

// XYZ to linear sRGB (IEC 61966-2-1), row by row, so that raw converters show the simulated
// channels as the red, green and blue of a screen. This matrix maps the illuminant D65 to (1, 1,
// 1).
constexpr std::array<float, 9> kColorMatrix = {3.2406F, -1.5372F, -0.4986F, -0.9689F, 1.8758F,
                                               0.0415F, 0.0557F,  -0.2040F, 1.0570F};
constexpr std::array<float, 3> kNeutral = {1.0F, 1.0F, 1.0F};
constexpr std::uint16_t kIlluminantD65 = 21;

void check(const DngMetadata& metadata) {
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument("write_dng: " + what);
  };
  if (metadata.make.empty() || metadata.model.empty()) refuse("make and model must not be empty");
  if (metadata.white_counts < 1 || metadata.white_counts > 65535) {
    refuse("white_counts must lie in 1 .. 65535, got " + std::to_string(metadata.white_counts));
  }
  for (const int black : metadata.black_counts) {
    if (black < 0 || black >= metadata.white_counts) {
      refuse("black_counts must lie in 0 .. white_counts - 1, got " + std::to_string(black));
    }
  }
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(metadata.exposure_s)) {
    refuse("exposure_s must be positive, got " + std::to_string(metadata.exposure_s));
  }
  if (!positive(metadata.f_number)) {
    refuse("f_number must be positive, got " + std::to_string(metadata.f_number));
  }
  // 65535 means "larger" in EXIF.
  if (metadata.iso < 1 || metadata.iso > 65534) {
    refuse("iso must lie in 1 .. 65534, got " + std::to_string(metadata.iso));
  }
  if (metadata.linearization_table.size() > kMaxCode + 1) {
    refuse("linearization_table must have at most 4096 entries, got " +
           std::to_string(metadata.linearization_table.size()));
  }
}

// Packs two samples into three bytes, most significant bits first. The width is even, so every row
// starts at a byte and no padding is needed.
std::vector<std::uint8_t> pack_12_bits(const std::vector<std::uint16_t>& codes) {
  std::vector<std::uint8_t> bytes(codes.size() / 2 * 3);
  for (std::size_t i = 0, o = 0; i + 1 < codes.size(); i += 2, o += 3) {
    const unsigned pair = static_cast<unsigned>(codes[i]) << 12U | codes[i + 1];
    bytes[o] = static_cast<std::uint8_t>(pair >> 16U);
    bytes[o + 1] = static_cast<std::uint8_t>(pair >> 8U);
    bytes[o + 2] = static_cast<std::uint8_t>(pair);
  }
  return bytes;
}

// Replaces libtiff's default handler, which prints; keeps the first error for the exception.
int keep_error(TIFF* /*tiff*/, void* message, const char* /*module*/, const char* format,
               va_list arguments) {
  auto& text = *static_cast<std::string*>(message);
  if (text.empty()) {
    std::array<char, 256> buffer{};
    std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
    text = buffer.data();
  }
  return 1;
}

int drop_warning(TIFF* /*tiff*/, void* /*user*/, const char* /*module*/, const char* /*format*/,
                 va_list /*arguments*/) {
  return 1;
}

struct TiffCloser {
  void operator()(TIFF* tiff) const { TIFFCleanup(tiff); }  // leaves the descriptor open
};
struct OptionsFree {
  void operator()(TIFFOpenOptions* options) const { TIFFOpenOptionsFree(options); }
};

// The EXIF directory (from which alone LibRaw reads the ISO speed) directly follows the header that
// libtiff writes when it opens the file; libtiff appends everything else.
constexpr std::uint32_t kExifOffset = 8;

bool write_exif(int descriptor, const std::vector<std::uint8_t>& exif) {
  return ::pwrite(descriptor, exif.data(), exif.size(), kExifOffset) ==
         static_cast<ssize_t>(exif.size());
}

bool set_image_fields(TIFF* tiff, int width_px, int height_px, const DngMetadata& metadata) {
  bool ok = true;
  const auto set = [&](std::uint32_t tag, auto... values) {
    ok = TIFFSetField(tiff, tag, values...) == 1 && ok;
  };
  set(TIFFTAG_SUBFILETYPE, 0);
  set(TIFFTAG_IMAGEWIDTH, width_px);
  set(TIFFTAG_IMAGELENGTH, height_px);
  set(TIFFTAG_BITSPERSAMPLE, 12);
  set(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_CFA);
  set(TIFFTAG_MAKE, metadata.make.c_str());
  set(TIFFTAG_MODEL, metadata.model.c_str());
  set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  set(TIFFTAG_SAMPLESPERPIXEL, 1);
  set(TIFFTAG_ROWSPERSTRIP, height_px);
  set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  set(TIFFTAG_SOFTWARE, "scattermeter");
  set(TIFFTAG_EXIFIFD, std::uint64_t{kExifOffset});

  const std::array<std::uint16_t, 2> repeat = {2, 2};
  std::array<std::uint8_t, 4> pattern{};
  std::transform(metadata.cfa.phase.begin(), metadata.cfa.phase.end(), pattern.begin(),
                 [](Channel channel) { return static_cast<std::uint8_t>(channel); });
  set(TIFFTAG_CFAREPEATPATTERNDIM, repeat.data());
  set(TIFFTAG_CFAPATTERN, 4, pattern.data());

  const std::array<std::uint8_t, 4> version = {1, 4, 0, 0};
  const std::array<std::uint8_t, 4> oldest_reader = {1, 1, 0, 0};
  set(TIFFTAG_DNGVERSION, version.data());
  set(TIFFTAG_DNGBACKWARDVERSION, oldest_reader.data());
  set(TIFFTAG_UNIQUECAMERAMODEL, metadata.model.c_str());
  const std::array<std::uint8_t, 3> planes = {0, 1, 2};
  set(TIFFTAG_CFAPLANECOLOR, 3, planes.data());
  set(TIFFTAG_CFALAYOUT, 1);
  if (!metadata.linearization_table.empty()) {
    set(TIFFTAG_LINEARIZATIONTABLE, static_cast<int>(metadata.linearization_table.size()),
        metadata.linearization_table.data());
  }
  const auto& black_counts = metadata.black_counts;
  const bool one_black = std::all_of(black_counts.begin(), black_counts.end(),
                                     [&](int black) { return black == black_counts[0]; });
  std::array<float, 4> black{};
  std::copy(black_counts.begin(), black_counts.end(), black.begin());
  if (!one_black) set(TIFFTAG_BLACKLEVELREPEATDIM, repeat.data());
  set(TIFFTAG_BLACKLEVEL, one_black ? 1 : 4, black.data());
  const auto white = static_cast<std::uint32_t>(metadata.white_counts);
  set(TIFFTAG_WHITELEVEL, 1, &white);
  set(TIFFTAG_COLORMATRIX1, 9, kColorMatrix.data());
  set(TIFFTAG_ASSHOTNEUTRAL, 3, kNeutral.data());
  set(TIFFTAG_CALIBRATIONILLUMINANT1, kIlluminantD65);
  return ok;
}

}  // namespace

void write_dng(const std::string& path, int width_px, int height_px,
               const std::vector<std::uint16_t>& codes, const DngMetadata& metadata) {
  if (width_px <= 0 || height_px <= 0 || width_px % 2 != 0 || height_px % 2 != 0 ||
      width_px > 65534 || height_px > 65534) {
    throw std::invalid_argument("write_dng: sides must be positive, even and below 65536, got " +
                                std::to_string(width_px) + " x " + std::to_string(height_px));
  }
  if (codes.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("write_dng: " + std::to_string(width_px) + " x " +
                                std::to_string(height_px) + " samples expected, got " +
                                std::to_string(codes.size()));
  }
  check(metadata);
  const int top_code = metadata.linearization_table.empty()
                           ? kMaxCode
                           : static_cast<int>(metadata.linearization_table.size()) - 1;
  const int largest = *std::max_element(codes.begin(), codes.end());
  if (largest > top_code) {
    throw std::invalid_argument("write_dng: code " + std::to_string(largest) +
                                " is above the largest allowed, " + std::to_string(top_code));
  }

  const std::vector<std::uint8_t> exif =
      exif_directory(kExifOffset, metadata.exposure_s, metadata.f_number, metadata.iso);
  PendingFile file(path);
  std::string error;
  const std::unique_ptr<TIFFOpenOptions, OptionsFree> options(TIFFOpenOptionsAlloc());
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_error, &error);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), drop_warning, nullptr);
  std::vector<std::uint8_t> bytes = pack_12_bits(codes);
  {
    // "l" selects little-endian, so that all machines write the same bytes.
    const std::unique_ptr<TIFF, TiffCloser> tiff(
        TIFFFdOpenExt(file.descriptor(), path.c_str(), "wl", options.get()));
    const bool written =
        tiff && write_exif(file.descriptor(), exif) &&
        set_image_fields(tiff.get(), width_px, height_px, metadata) &&
        TIFFWriteEncodedStrip(tiff.get(), 0, bytes.data(), static_cast<tmsize_t>(bytes.size())) ==
            static_cast<tmsize_t>(bytes.size()) &&
        TIFFWriteDirectory(tiff.get()) == 1;
    if (!written) {
      throw InputError(path, "cannot be written: " + (error.empty() ? "libtiff failed" : error));
    }
  }
  file.commit();
}

}  // namespace scattermeter::capture
