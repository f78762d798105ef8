#include "capture/files/png.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

namespace scattermeter::capture {
namespace {

std::uint32_t big_endian(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8U | bytes.at(at + k);
  return value;
}

// CRC-32 of PNG (ISO/IEC 15948, annex D), bit by bit.
std::uint32_t crc(const std::vector<std::uint8_t>& bytes, std::size_t from, std::size_t size) {
  std::uint32_t c = 0xffffffffU;
  for (std::size_t i = from; i < from + size; ++i) {
    c ^= bytes.at(i);
    for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? 0xedb88320U ^ (c >> 1U) : c >> 1U;
  }
  return c ^ 0xffffffffU;
}

const std::vector<std::uint8_t> kSixPixels = {255, 0, 0, 0, 255, 0, 0, 0, 255,
                                              1,   2, 3, 4, 5,   6, 7, 8, 9};

TEST(Png, HeaderNamesSizeAndFormat) {
  const std::vector<std::uint8_t> png = png_of_rgb(3, 2, kSixPixels);
  const std::vector<std::uint8_t> signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  ASSERT_GT(png.size(), 33U);
  EXPECT_TRUE(std::equal(signature.begin(), signature.end(), png.begin()));
  EXPECT_EQ(big_endian(png, 8), 13U);
  EXPECT_EQ(std::string(png.begin() + 12, png.begin() + 16), "IHDR");
  EXPECT_EQ(big_endian(png, 16), 3U);
  EXPECT_EQ(big_endian(png, 20), 2U);
  EXPECT_EQ(png[24], 4);  // bits an index, for six colours
  EXPECT_EQ(png[25], 3);  // indices into a palette
}

// Whole chunks with right checksums from the signature to IEND and nothing behind it.
TEST(Png, IsAListOfSoundChunks) {
  const std::vector<std::uint8_t> png = png_of_rgb(3, 2, kSixPixels);
  std::size_t at = 8;
  std::string last;
  bool has_data = false;
  while (at < png.size()) {
    const std::size_t size = big_endian(png, at);
    ASSERT_LE(at + 12 + size, png.size());
    last.assign(png.begin() + static_cast<std::ptrdiff_t>(at) + 4,
                png.begin() + static_cast<std::ptrdiff_t>(at) + 8);
    has_data = has_data || last == "IDAT";
    EXPECT_EQ(big_endian(png, at + 8 + size), crc(png, at + 4, 4 + size)) << last;
    at += 12 + size;
  }
  EXPECT_EQ(at, png.size());
  EXPECT_EQ(last, "IEND");
  EXPECT_TRUE(has_data);
}

TEST(Png, SamePixelsSameBytesAndOthersNot) {
  std::vector<std::uint8_t> other = kSixPixels;
  EXPECT_EQ(png_of_rgb(3, 2, other), png_of_rgb(3, 2, kSixPixels));
  other[10] = 77;
  EXPECT_NE(png_of_rgb(3, 2, other), png_of_rgb(3, 2, kSixPixels));
}

std::vector<std::uint8_t> read_back(const std::vector<std::uint8_t>& png) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, rgb.data(), 0, nullptr), 0);
  return rgb;
}

// With a palette up to 256 colours, and without one beyond.
TEST(Png, ShowsThePixels) {
  for (const int colours : {2, 256, 257, 1000}) {
    std::vector<std::uint8_t> rgb;
    for (int i = 0; i < 1000; ++i) {
      const int c = i % colours;
      for (const int v : {c % 256, c / 256, 255 - c % 256}) {
        rgb.push_back(static_cast<std::uint8_t>(v));
      }
    }
    const std::vector<std::uint8_t> png = png_of_rgb(40, 25, rgb);
    EXPECT_EQ(png[25], colours <= 256 ? 3 : 2) << colours;
    EXPECT_EQ(read_back(png), rgb) << colours;
  }
}

TEST(Png, RefusesAnotherNumberOfValues) {
  EXPECT_THROW(png_of_rgb(3, 3, kSixPixels), std::invalid_argument);
  EXPECT_THROW(png_of_rgb(0, 0, {}), std::invalid_argument);
  EXPECT_THROW(png_of_rgb(-3, -2, kSixPixels), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
