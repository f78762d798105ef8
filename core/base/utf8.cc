#include "core/base/utf8.h"

#include <bit>
#include <cstdint>

namespace scattermeter {
namespace {

// Bytes of the valid character at the beginning of the text, which is not empty; 0 for none.
std::size_t character_bytes(std::string_view text) {
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const auto ones = static_cast<std::size_t>(std::countl_one(byte(0)));
  if (ones == 0) return 1;
  if (ones == 1 || ones > 4 || text.size() < ones) return 0;
  std::uint32_t code = byte(0) & (0x7FU >> ones);
  for (std::size_t i = 1; i < ones; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code >= kLeast[ones] && code <= 0x10FFFF && !is_surrogate ? ones : 0;
}

}  // namespace

std::size_t first_no_utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t bytes = character_bytes(text.substr(at));
    if (bytes == 0) break;
    at += bytes;
  }
  return at;
}

}  // namespace scattermeter
