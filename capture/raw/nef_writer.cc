#include "capture/raw/nef_writer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "capture/raw/exif_directory.h"
#include "capture/raw/nikon_compression.h"
#include "capture/raw/nikon_maker_note.h"
#include "capture/raw/tiff_output.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::capture {
namespace {

// What dcraw and LibRaw cut off a D80's frame on its right and lower side.
constexpr int kExtraColumns = 4;
constexpr int kExtraRows = 3;
constexpr int kNikonCompression = 34713;
// As found in a photograph of a D2H; any number would do.
constexpr std::uint16_t kFirstPrediction = 328;
constexpr int kMaxThumbnailWidth_px = 160;

void check_nef(const RawMetadata& metadata) {
  const RawMetadata d80;
  const auto refuse = [](const std::string& what) {
    throw std::invalid_argument("write_nef: " + what);
  };
  if (metadata.make != d80.make || metadata.model != d80.model) {
    refuse("make and model must be NIKON CORPORATION, NIKON D80; got " + metadata.make + ", " +
           metadata.model);
  }
  if (metadata.white_counts != d80.white_counts) {
    refuse("white_counts must be 4095, got " + std::to_string(metadata.white_counts));
  }
  const std::vector<std::uint16_t>& table = metadata.linearization_table;
  if (table.size() < 2 ||
      std::adjacent_find(table.begin(), table.end(), std::greater_equal<>()) != table.end()) {
    refuse("linearization_table must have two or more entries that ascend strictly");
  }
}

// The frame with its border, each sample of which repeats the nearest one of its phase.
std::vector<std::uint16_t> with_border(const std::vector<std::uint16_t>& codes, int width_px,
                                       int height_px) {
  const auto nearest = [](int at, int size) { return at < size ? at : size - 2 + (at - size) % 2; };
  std::vector<std::uint16_t> out;
  out.reserve(static_cast<std::size_t>(width_px + kExtraColumns) *
              static_cast<std::size_t>(height_px + kExtraRows));
  for (int y = 0; y < height_px + kExtraRows; ++y) {
    for (int x = 0; x < width_px + kExtraColumns; ++x) {
      out.push_back(codes[static_cast<std::size_t>(nearest(y, height_px)) *
                              static_cast<std::size_t>(width_px) +
                          static_cast<std::size_t>(nearest(x, width_px))]);
    }
  }
  return out;
}

// An 8-bit RGB picture, smaller than the frame by a whole factor of 2 or more (decoders take the
// larger picture for the raw one): means of squares of samples above black, with a gamma of 2.
struct Thumbnail {
  int width_px, height_px;
  std::vector<std::uint8_t> rgb;
};

Thumbnail thumbnail(const std::vector<std::uint16_t>& codes, int width_px, int height_px,
                    const RawMetadata& metadata) {
  const int factor = 2 * ((width_px + 2 * kMaxThumbnailWidth_px - 1) / (2 * kMaxThumbnailWidth_px));
  Thumbnail out{std::max(1, width_px / factor), std::max(1, height_px / factor), {}};
  out.rgb.reserve(3 * static_cast<std::size_t>(out.width_px * out.height_px));
  for (int row = 0; row < out.height_px; ++row) {
    for (int column = 0; column < out.width_px; ++column) {
      std::array<double, kChannels> sum{}, n{};
      for (int y = factor * row; y < std::min(height_px, factor * (row + 1)); ++y) {
        for (int x = factor * column; x < std::min(width_px, factor * (column + 1)); ++x) {
          const std::size_t phase = cfa_phase(x, y);
          const auto c = static_cast<std::size_t>(metadata.cfa.phase[phase]);
          const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                          static_cast<std::size_t>(x);
          const double black = metadata.black_counts[phase];
          sum[c] +=
              (metadata.linearization_table[codes[at]] - black) / (metadata.white_counts - black);
          n[c] += 1;
        }
      }
      for (std::size_t c = 0; c < kChannels; ++c) {
        const double share = n[c] > 0 ? std::clamp(sum[c] / n[c], 0.0, 1.0) : 0.0;
        out.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * std::sqrt(share))));
      }
    }
  }
  return out;
}

void write_first_directory(TiffOutput& tiff, const Thumbnail& picture,
                           const RawMetadata& metadata) {
  const std::array<std::uint16_t, 3> bits = {8, 8, 8};
  const std::array<std::uint64_t, 1> sub_directories = {0};  // libtiff enters the place
  tiff.set(TIFFTAG_SUBFILETYPE, FILETYPE_REDUCEDIMAGE);
  tiff.set(TIFFTAG_IMAGEWIDTH, picture.width_px);
  tiff.set(TIFFTAG_IMAGELENGTH, picture.height_px);
  tiff.set(TIFFTAG_SAMPLESPERPIXEL, 3);
  tiff.set(TIFFTAG_BITSPERSAMPLE, bits[0]);
  tiff.set(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  tiff.set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
  tiff.set(TIFFTAG_MAKE, metadata.make.c_str());
  tiff.set(TIFFTAG_MODEL, metadata.model.c_str());
  tiff.set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
  tiff.set(TIFFTAG_ROWSPERSTRIP, picture.height_px);
  tiff.set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  tiff.set(TIFFTAG_SOFTWARE, "scattermeter");
  tiff.set(TIFFTAG_SUBIFD, 1, sub_directories.data());
  tiff.set(TIFFTAG_EXIFIFD, std::uint64_t{TiffOutput::kBlockOffset});
  tiff.strip(picture.rgb);
  tiff.end_directory();
}

void write_raw_directory(TiffOutput& tiff, std::vector<std::uint8_t> bytes, int raw_width_px,
                         int raw_height_px, const CfaPattern& cfa) {
  const std::array<std::uint16_t, 2> repeat = {2, 2};
  std::array<std::uint8_t, 4> pattern{};
  std::transform(cfa.phase.begin(), cfa.phase.end(), pattern.begin(),
                 [](Channel channel) { return static_cast<std::uint8_t>(channel); });
  tiff.set(TIFFTAG_SUBFILETYPE, 0);
  tiff.set(TIFFTAG_IMAGEWIDTH, raw_width_px);
  tiff.set(TIFFTAG_IMAGELENGTH, raw_height_px);
  tiff.set(TIFFTAG_SAMPLESPERPIXEL, 1);
  tiff.set(TIFFTAG_BITSPERSAMPLE, 12);
  tiff.set(TIFFTAG_COMPRESSION, kNikonCompression);
  tiff.set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_CFA);
  tiff.set(TIFFTAG_ROWSPERSTRIP, raw_height_px);
  tiff.set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  tiff.set(TIFFTAG_CFAREPEATPATTERNDIM, repeat.data());
  tiff.set(TIFFTAG_CFAPATTERN, 4, pattern.data());
  tiff.strip(std::move(bytes));
  tiff.end_directory();
}

// Decoders take a strip of one of these sizes for an uncompressed or differently packed one (dcraw
// 9.28, identify(), compression 34713); one more byte, which no decoder reads, tells them apart.
bool size_misleads(std::size_t bytes, int raw_width_px, int raw_height_px) {
  const auto width = static_cast<std::size_t>(raw_width_px);
  const auto height = static_cast<std::size_t>(raw_height_px);
  return bytes == (width + 9) / 10 * 16 * height || 2 * bytes == 3 * width * height ||
         bytes == 3 * width * height || bytes == 2 * width * height;
}

}  // namespace

void write_nef(const std::string& path, int width_px, int height_px,
               const std::vector<std::uint16_t>& codes, const RawMetadata& metadata) {
  check_raw("write_nef", width_px, height_px, codes, metadata);
  check_nef(metadata);
  const int raw_width_px = width_px + kExtraColumns;
  const int raw_height_px = height_px + kExtraRows;
  std::vector<std::uint8_t> bytes = nikon_compressed(with_border(codes, width_px, height_px),
                                                     raw_width_px, raw_height_px, kFirstPrediction);
  while (size_misleads(bytes.size(), raw_width_px, raw_height_px)) bytes.push_back(0);

  TiffOutput tiff(
      path, ByteOrder::kBigEndian,
      exif_directory(TiffOutput::kBlockOffset, metadata.exposure_s, metadata.f_number, metadata.iso,
                     ByteOrder::kBigEndian, nikon_maker_note(metadata, kFirstPrediction)));
  write_first_directory(tiff, thumbnail(codes, width_px, height_px, metadata), metadata);
  write_raw_directory(tiff, std::move(bytes), raw_width_px, raw_height_px, metadata.cfa);
  tiff.commit();
}

}  // namespace scattermeter::capture
