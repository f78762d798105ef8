#include "capture/raw/dng_writer.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "capture/raw/exif_directory.h"
#include "capture/raw/tiff_output.h"

namespace scattermeter::capture {
namespace {

// XYZ to linear sRGB (IEC 61966-2-1), row by row, so that raw converters show the simulated
// channels as the red, green and blue of a screen. This matrix maps the illuminant D65 to (1, 1,
// 1).
constexpr std::array<float, 9> kColorMatrix = {3.2406F, -1.5372F, -0.4986F, -0.9689F, 1.8758F,
                                               0.0415F, 0.0557F,  -0.2040F, 1.0570F};
constexpr std::array<float, 3> kNeutral = {1.0F, 1.0F, 1.0F};
constexpr std::uint16_t kIlluminantD65 = 21;

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

void set_image_fields(TiffOutput& tiff, int width_px, int height_px, const RawMetadata& metadata) {
  const auto set = [&](std::uint32_t tag, auto... values) { tiff.set(tag, values...); };
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
  set(TIFFTAG_EXIFIFD, std::uint64_t{TiffOutput::kBlockOffset});

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
}

}  // namespace

void write_dng(const std::string& path, int width_px, int height_px,
               const std::vector<std::uint16_t>& codes, const RawMetadata& metadata) {
  check_raw("write_dng", width_px, height_px, codes, metadata);
  // LibRaw reads the ISO speed from the EXIF directory only.
  TiffOutput tiff(path, ByteOrder::kLittleEndian,
                  exif_directory(TiffOutput::kBlockOffset, metadata.exposure_s, metadata.f_number,
                                 metadata.iso));
  set_image_fields(tiff, width_px, height_px, metadata);
  tiff.strip(pack_12_bits(codes));
  tiff.end_directory();
  tiff.commit();
}

}  // namespace scattermeter::capture
