#include "capture/raw/nikon_compression.h"

#include <algorithm>
#include <filesystem>
#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/capture/nikon_decoder.h"
#include "tests/fixtures/draws.h"
#include "tests/fixtures/shared_file.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using testing::ElementsAre;

// Differences 0, 1, -1, 5, -5, 0: 11110, 1110 1, 1110 0, 011 101, 011 010, 11110.
TEST(NikonCompression, BitsOfAnExample) {
  // Row 0 is predicted by 100 in both columns; then by two columns to the left.
  EXPECT_THAT(nikon_compressed({100, 101, 99, 106, 94, 106}, 6, 1, 100),
              ElementsAre(0b11110111, 0b01111000, 0b11101011, 0b01011110));
}

TEST(NikonCompression, ImagesOfEveryKindComeBack) {
  std::mt19937 generator(11);
  const auto uniform = [&](int from, int to) {
    return std::uniform_int_distribution<int>(from, to)(generator);
  };
  for (int draw = 0; draw < test_support::draws(200, 20'000); ++draw) {
    const int width = uniform(2, 40);
    const int height = uniform(1, 30);
    const int top = uniform(0, 1) != 0 ? 4095 : 682;
    const auto first = static_cast<std::uint16_t>(uniform(0, 4095));
    std::vector<std::uint16_t> codes;
    int walk = uniform(0, top);
    const int kind = draw % 4;  // noise, a walk of random step, extremes, uniform
    const int step = 1 << uniform(0, 11);
    for (int i = 0; i < width * height; ++i) {
      if (kind == 0) walk = uniform(0, top);
      if (kind == 1) walk = std::clamp(walk + uniform(-step, step), 0, top);
      if (kind == 2) walk = uniform(0, 1) * top;
      codes.push_back(static_cast<std::uint16_t>(walk));
    }
    const std::vector<std::uint8_t> bytes = nikon_compressed(codes, width, height, first);
    const NikonStrip strip = decoded_nikon_strip(bytes, static_cast<std::size_t>(width),
                                                 static_cast<std::size_t>(height), first);
    ASSERT_TRUE(strip.codes == codes) << "draw " << draw;
    ASSERT_EQ(strip.bytes_read, bytes.size());
  }
}

// The strip of a camera, decoded and encoded again, is the camera's own, byte by byte.
TEST(NikonCompression, IsThatOfACamera) {
  const std::string path = shared_file("data/raw/nikon_d2h_12bit_compressed.nef");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << shared_file_missing(path);
  const std::vector<std::uint8_t> file = read_file(path);
  // exiftool: StripOffsets, StripByteCounts, size, NEFLinearizationTable.
  constexpr std::ptrdiff_t kOffset = 174'684;
  constexpr std::ptrdiff_t kBytes = 3'061'333;
  const std::vector<std::uint8_t> strip(file.begin() + kOffset, file.begin() + kOffset + kBytes);
  const NikonStrip decoded = decoded_nikon_strip(strip, 2496, 1648, 328);
  std::vector<std::uint8_t> again = nikon_compressed(decoded.codes, 2496, 1648, 328);
  ASSERT_LE(again.size(), strip.size());
  EXPECT_EQ(again.size(), decoded.bytes_read);
  // The last byte is filled up as the camera likes.
  again.pop_back();
  EXPECT_TRUE(std::equal(again.begin(), again.end(), strip.begin()));
}

TEST(NikonCompression, RefusesBrokenPreconditions) {
  EXPECT_THROW(nikon_compressed({1, 2, 3}, 2, 2, 0), std::invalid_argument);
  EXPECT_THROW(nikon_compressed({1, 2}, 1, 2, 0), std::invalid_argument);
  EXPECT_THROW(nikon_compressed({1, 4096}, 2, 1, 0), std::invalid_argument);
  EXPECT_THROW(nikon_compressed({1, 2}, 2, 1, 4096), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
