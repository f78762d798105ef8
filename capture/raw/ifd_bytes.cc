#include "capture/raw/ifd_bytes.h"

namespace scattermeter::capture {
namespace {

enum FieldType : unsigned { kAscii = 2, kShort = 3, kRational = 5, kUndefined = 7 };

constexpr std::size_t kInline = 4;  // bytes of a value that stands in its entry

}  // namespace

void IfdBytes::put(std::vector<std::uint8_t>& out, std::uint32_t value, int bytes) const {
  for (int i = 0; i < bytes; ++i) {
    const int shift = 8 * (order_ == ByteOrder::kLittleEndian ? i : bytes - 1 - i);
    out.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

void IfdBytes::shorts(unsigned tag, const std::vector<std::uint16_t>& values) {
  Field field{tag, kShort, static_cast<std::uint32_t>(values.size()), {}};
  for (const std::uint16_t value : values) put(field.value, value, 2);
  fields_.push_back(std::move(field));
}

void IfdBytes::rationals(unsigned tag, const std::vector<Rational>& values) {
  Field field{tag, kRational, static_cast<std::uint32_t>(values.size()), {}};
  for (const Rational& value : values) {
    put(field.value, value.numerator, 4);
    put(field.value, value.denominator, 4);
  }
  fields_.push_back(std::move(field));
}

void IfdBytes::ascii(unsigned tag, std::string_view text) {
  Field field{tag, kAscii, static_cast<std::uint32_t>(text.size() + 1), {text.begin(), text.end()}};
  field.value.push_back(0);
  fields_.push_back(std::move(field));
}

void IfdBytes::undefined(unsigned tag, const std::vector<std::uint8_t>& bytes) {
  fields_.push_back({tag, kUndefined, static_cast<std::uint32_t>(bytes.size()), bytes});
}

std::vector<std::uint8_t> IfdBytes::at(std::uint32_t offset) const {
  const std::size_t values_at = offset + 2 + 12 * fields_.size() + 4;
  std::vector<std::uint8_t> out, values;
  put(out, static_cast<std::uint32_t>(fields_.size()), 2);
  for (const Field& field : fields_) {
    put(out, field.tag, 2);
    put(out, field.type, 2);
    put(out, field.count, 4);
    if (field.value.size() <= kInline) {
      out.insert(out.end(), field.value.begin(), field.value.end());
      out.resize(out.size() + kInline - field.value.size());
    } else {
      put(out, static_cast<std::uint32_t>(values_at + values.size()), 4);
      values.insert(values.end(), field.value.begin(), field.value.end());
      values.resize(values.size() + values.size() % 2);
    }
  }
  put(out, 0, 4);
  out.insert(out.end(), values.begin(), values.end());
  return out;
}

}  // namespace scattermeter::capture
