// Raw files made byte by byte, so that the reader meets layouts that the writer never makes: odd
// margins, other bit depths, several strips, tiles, lossless JPEG. Directories first, samples last.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace scattermeter::capture {

using Bytes = std::vector<std::uint8_t>;

class TiffBytes {
 public:
  void bytes(unsigned tag, const Bytes& values);
  void ascii(unsigned tag, const std::string& text);
  void shorts(unsigned tag, const std::vector<unsigned>& values);
  void longs(unsigned tag, const std::vector<unsigned>& values);
  void rationals(unsigned tag, const std::vector<unsigned>& numerators, unsigned denominator);
  void remove(unsigned tag) { fields_.erase(tag); }

  // Little-endian file with the fields, the EXIF directory if one is given, and the parts (strips,
  // or tiles) `gap` bytes apart. Sets StripOffsets and StripByteCounts (TileOffsets, ...).
  Bytes file(const std::vector<Bytes>& parts, bool tiled = false, std::size_t gap = 0);

  TiffBytes* exif = nullptr;

 private:
  struct Field {
    unsigned type;
    std::size_t count;
    Bytes data;
  };
  std::map<unsigned, Field> fields_;

  std::size_t size() const;
  void append_to(Bytes& file) const;
};

struct TestImage {
  unsigned width = 0;  // of the whole sensor
  unsigned height = 0;
  unsigned bits = 12;
  std::vector<std::uint16_t> codes;  // pseudo-random, below 2^bits
};
TestImage random_image(unsigned width, unsigned height, unsigned bits, unsigned seed = 1);

// A CFA DNG of that image's shape: all fields that LibRaw needs, the pattern RGGB, black 0, the
// white level of the bit depth, 1/50 s, ISO 200, f/5.6, "Acme X1".
class CfaDng : public TiffBytes {
 public:
  explicit CfaDng(const TestImage& image);
  CfaDng(const CfaDng&) = delete;
  CfaDng& operator=(const CfaDng&) = delete;

 private:
  TiffBytes exif_fields_;
};

// Rows [first, first + count) as the file stores them: 16 bits little-endian, fewer bits packed
// with the most significant first, rows padded to whole bytes.
Bytes packed_rows(const TestImage& image, unsigned first, unsigned count);
// The same rows as a lossless JPEG stream (ITU-T T.81, process 14, predictor 1, one component).
Bytes lossless_jpeg_rows(const TestImage& image, unsigned first, unsigned count);

}  // namespace scattermeter::capture
