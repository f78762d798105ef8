#include "capture/raw/nikon_compression.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace scattermeter::capture {
namespace {

constexpr std::uint16_t kMaxNikonCode = 4095;
constexpr int kCategories = 13;  // numbers of bits of a difference, 0 .. 12

// The Huffman tree of 12-bit lossy files: how many categories have a code of 1, 2, ... bits, and
// the categories in the order of their codes.
constexpr std::array<int, 10> kCodesOfLength = {0, 1, 5, 1, 1, 1, 1, 1, 1, 1};
constexpr std::array<int, kCategories> kCategoryOrder = {5, 4, 3, 6, 2, 7, 1, 0, 8, 9, 11, 10, 12};

struct HuffmanCode {
  std::uint32_t bits = 0;
  int length = 0;
};

// Canonical: codes of one length are consecutive numbers; the first of the next length follows the
// last one with a zero appended.
constexpr std::array<HuffmanCode, kCategories> kHuffman = [] {
  std::array<HuffmanCode, kCategories> codes{};
  std::uint32_t next = 0;
  std::size_t leaf = 0;
  for (std::size_t length = 1; length <= kCodesOfLength.size(); ++length) {
    for (int i = 0; i < kCodesOfLength[length - 1]; ++i) {
      codes[static_cast<std::size_t>(kCategoryOrder[leaf++])] = {next++, static_cast<int>(length)};
    }
    next <<= 1U;
  }
  return codes;
}();

class BitWriter {
 public:
  // At most 24 bits, most significant first.
  void put(std::uint32_t bits, int length) {
    held_ = held_ << static_cast<unsigned>(length) | bits;
    n_held_ += length;
    for (; n_held_ >= 8; n_held_ -= 8) {
      bytes_.push_back(static_cast<std::uint8_t>(held_ >> static_cast<unsigned>(n_held_ - 8)));
    }
  }
  // Fills the last byte with zeros.
  std::vector<std::uint8_t> take() {
    if (n_held_ > 0) put(0, 8 - n_held_);
    return std::move(bytes_);
  }

 private:
  std::vector<std::uint8_t> bytes_;
  std::uint64_t held_ = 0;  // the last n_held_ bits are still to be written
  int n_held_ = 0;
};

void put_difference(BitWriter& out, int difference) {
  const auto category =
      static_cast<int>(std::bit_width(static_cast<unsigned>(std::abs(difference))));
  const HuffmanCode& code = kHuffman[static_cast<std::size_t>(category)];
  const std::uint32_t range = 1U << static_cast<unsigned>(category);
  const auto bits = static_cast<std::uint32_t>(difference < 0 ? difference - 1 : difference);
  out.put(code.bits << static_cast<unsigned>(category) | (bits & (range - 1)),
          code.length + category);
}

}  // namespace

std::vector<std::uint8_t> nikon_compressed(const std::vector<std::uint16_t>& codes, int width_px,
                                           int height_px, std::uint16_t first_prediction) {
  if (width_px < 2 || height_px < 1 ||
      codes.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("nikon_compressed: " + std::to_string(width_px) + " x " +
                                std::to_string(height_px) + " codes expected, got " +
                                std::to_string(codes.size()));
  }
  if (std::max(first_prediction, *std::max_element(codes.begin(), codes.end())) > kMaxNikonCode) {
    throw std::invalid_argument("nikon_compressed: a code is above 4095");
  }
  std::array<std::array<std::uint16_t, 2>, 2> above{};  // [row parity][column]
  for (auto& row : above) row.fill(first_prediction);
  BitWriter out;
  const auto width = static_cast<std::size_t>(width_px);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height_px); ++y) {
    const std::uint16_t* row = &codes[y * width];
    for (std::size_t x = 0; x < width; ++x) {
      const int prediction = x < 2 ? above[y % 2][x] : row[x - 2];
      put_difference(out, row[x] - prediction);
    }
    above[y % 2] = {row[0], row[1]};
  }
  return out.take();
}

}  // namespace scattermeter::capture
