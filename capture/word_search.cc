#include "capture/word_search.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <vector>

#include "core/input_error.h"

namespace scattermeter::capture {
namespace {

using Byte = unsigned char;

constexpr std::size_t kBlock = 4096;          // places looked at together
constexpr std::size_t kChunk = 256 * kBlock;  // places read together

// Whether the byte is the small letter or its capital.
bool is_letter(Byte byte, Byte small) { return static_cast<Byte>(byte | 0x20U) == small; }

bool says(const Byte* at, std::string_view word, std::size_t stride) {
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (!is_letter(at[i * stride], static_cast<Byte>(word[i]))) return false;
  }
  return true;
}

// Whether the word begins at one of the places of a block. A raw has its first four letters by
// chance once in 10^8 places, so that all places are held against them first, in vectors, and
// against the rest where they occur.
template <std::size_t kStride>
bool block_says(const Byte* block, std::string_view word) {
  const Byte a = static_cast<Byte>(word[0]);
  const Byte b = static_cast<Byte>(word[1]);
  const Byte c = static_cast<Byte>(word[2]);
  const Byte d = static_cast<Byte>(word[3]);
  Byte begun = 0;
  for (std::size_t i = 0; i < kBlock; ++i) {
    const Byte* at = block + i;
    begun |= static_cast<Byte>(is_letter(at[0], a)) & static_cast<Byte>(is_letter(at[kStride], b)) &
             static_cast<Byte>(is_letter(at[2 * kStride], c)) &
             static_cast<Byte>(is_letter(at[3 * kStride], d));
  }
  if (begun == 0) return false;
  for (std::size_t i = 0; i < kBlock; ++i) {
    if (says(block + i, word, kStride)) return true;
  }
  return false;
}

}  // namespace

bool says_word(const std::string& path, std::string_view word) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, "cannot be opened");
  const std::size_t tail = 2 * word.size();  // bytes after a place that its word may reach to
  // Zeros after what is read, so that a block may begin at its last byte.
  std::vector<Byte> bytes(kChunk + tail + kBlock + tail);
  const auto end = bytes.begin() + kChunk + static_cast<std::ptrdiff_t>(tail);
  std::size_t held = 0;  // bytes of the places to come that are read already
  do {
    file.read(reinterpret_cast<char*>(bytes.data() + held),
              static_cast<std::streamsize>(kChunk + tail - held));
    held += static_cast<std::size_t>(file.gcount());
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(held), end, Byte{0});
    for (std::size_t at = 0; at < held; at += kBlock) {
      if (block_says<1>(&bytes[at], word) || block_says<2>(&bytes[at], word)) return true;
    }
    std::copy(end - static_cast<std::ptrdiff_t>(tail), end, bytes.begin());
    held = tail;
  } while (file);
  return false;
}

}  // namespace scattermeter::capture
