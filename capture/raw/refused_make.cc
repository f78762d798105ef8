#include "capture/raw/refused_make.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string_view>

#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

constexpr std::string_view kWord = "hasselblad";
constexpr std::size_t kChunk = std::size_t{1} << 20U;

// By how many letters the word may move on after the byte under its last letter (Horspool, 1980).
constexpr std::array<std::uint8_t, 256> kShift = [] {
  std::array<std::uint8_t, 256> shift{};
  shift.fill(kWord.size());
  for (std::size_t i = 0; i + 1 < kWord.size(); ++i) {
    const auto letter = static_cast<std::uint8_t>(kWord[i]);
    shift[letter] = shift[letter ^ 0x20U] = static_cast<std::uint8_t>(kWord.size() - 1 - i);
  }
  return shift;
}();

// Whether the word occurs in `bytes` with its letters `stride` bytes apart.
bool contains_word(std::string_view bytes, std::size_t stride) {
  const std::size_t span = (kWord.size() - 1) * stride;
  for (std::size_t phase = 0; phase < stride; ++phase) {
    for (std::size_t at = phase; at + span < bytes.size();) {
      std::size_t i = 0;
      while (i < kWord.size() && (bytes[at + i * stride] | 0x20) == kWord[i]) ++i;
      if (i == kWord.size()) return true;
      at += stride * kShift[static_cast<std::uint8_t>(bytes[at + span])];
    }
  }
  return false;
}

}  // namespace

void refuse_unsafe_make(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, "cannot be opened");
  std::string bytes;
  while (file) {
    // The end of the last chunk may hold the beginning of the word.
    bytes.erase(0, bytes.size() - std::min(bytes.size(), 2 * kWord.size()));
    const std::size_t kept = bytes.size();
    bytes.resize(kept + kChunk);
    file.read(bytes.data() + kept, kChunk);
    bytes.resize(kept + static_cast<std::size_t>(file.gcount()));
    if (contains_word(bytes, 1) || contains_word(bytes, 2)) {
      throw InputError(path,
                       "contains the name Hasselblad: raw files of this make are not supported, "
                       "because LibRaw 0.20 can overrun its memory on the camera names in them");
    }
  }
}

}  // namespace scattermeter::capture
