// Encoding of a TIFF directory (IFD).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace scattermeter::capture {

enum class ByteOrder { kLittleEndian, kBigEndian };

struct Rational {
  std::uint32_t numerator;
  std::uint32_t denominator;
};

// Fields are added in ascending order of their tags, as TIFF 6.0 requires.
class IfdBytes {
 public:
  explicit IfdBytes(ByteOrder order) : order_(order) {}

  void shorts(unsigned tag, const std::vector<std::uint16_t>& values);
  void rationals(unsigned tag, const std::vector<Rational>& values);
  void ascii(unsigned tag, std::string_view text);  // a final 0 is added
  void undefined(unsigned tag, const std::vector<std::uint8_t>& bytes);

  // The directory for byte `offset` of the file (even), without a successor, followed by the values
  // of more than four bytes, each at an even offset.
  std::vector<std::uint8_t> at(std::uint32_t offset) const;

 private:
  struct Field {
    unsigned tag;
    unsigned type;
    std::uint32_t count;
    std::vector<std::uint8_t> value;
  };

  void put(std::vector<std::uint8_t>& out, std::uint32_t value, int bytes) const;

  ByteOrder order_;
  std::vector<Field> fields_;
};

}  // namespace scattermeter::capture
