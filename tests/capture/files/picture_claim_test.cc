#include "capture/files/picture_claim.h"

#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

using namespace std::string_literals;

std::string big(std::uint32_t value, int count) {
  std::string out;
  while (count-- > 0) out += static_cast<char>(value >> (8 * count));
  return out;
}

std::string little(std::uint32_t value, int count) {
  std::string out = big(value, count);
  return {out.rbegin(), out.rend()};
}

std::optional<PictureClaim> claim_of(const std::string& bytes) {
  std::istringstream file(bytes);
  return picture_claim(file);
}

void expect_claim(const std::string& bytes, std::uint32_t width_px, std::uint32_t height_px,
                  double pixels = 0) {
  const auto claim = claim_of(bytes);
  ASSERT_TRUE(claim.has_value());
  EXPECT_EQ(claim->width_px, width_px);
  EXPECT_EQ(claim->height_px, height_px);
  EXPECT_EQ(claim->pixels, pixels > 0 ? pixels : static_cast<double>(width_px) * height_px);
  // A truncated header claims nothing.
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_FALSE(claim_of(bytes.substr(0, n)).has_value()) << n << " of " << bytes.size();
  }
}

TEST(PictureKind, IsToldByTheFirstBytes) {
  const auto kind = [](const std::string& bytes) {
    std::istringstream file(bytes);
    return picture_kind(file);
  };
  EXPECT_EQ(kind("\xff\xd8\xff\xe1 and more"), "JPEG");
  EXPECT_EQ(kind("\x89PNG\r\n\x1a\n"), "PNG");
  EXPECT_EQ(kind("MM\0*\0\0\0\10"s), "TIFF");
  EXPECT_EQ(kind("RIFF1234WEBP"), "WebP");
  EXPECT_EQ(kind("P5\n2 2\n"), "PNM");
  EXPECT_EQ(kind("BM"), "BMP");
  EXPECT_EQ(kind("hello"), "");
  EXPECT_EQ(kind(""), "");
}

TEST(PictureClaim, Png) {
  expect_claim("\x89PNG\r\n\x1a\n" + big(13, 4) + "IHDR" + big(70'000, 4) + big(3, 4), 70'000, 3);
  EXPECT_FALSE(claim_of("\x89PNG\r\n\x1a\n" + big(13, 4) + "IDAT" + big(7, 4) + big(3, 4)));
}

TEST(PictureClaim, JpegAfterOtherSegments) {
  const std::string exif = "\xff\xe1" + big(2 + 9, 2) + "Exif\0\0abc"s;
  const std::string fill = "\xff\xff";
  const std::string frame = "\xff\xc2" + big(11, 2) + "\x08" + big(2000, 2) + big(3000, 2);
  expect_claim("\xff\xd8" + exif + fill + frame, 3000, 2000);
  EXPECT_FALSE(claim_of("\xff\xd8" + exif + "xx" + frame));
  EXPECT_FALSE(claim_of("\xff\xd8\xff\xda" + big(2, 2) + frame));  // samples before a frame
  EXPECT_FALSE(claim_of("\xff\xd8" + std::string(100'000, '\xff')));
}

TEST(PictureClaim, Bmp) {
  const std::string head = "BM" + std::string(12, '\0');
  expect_claim(head + little(40, 4) + little(640, 4) + little(480, 4), 640, 480);
  expect_claim(head + little(40, 4) + little(640, 4) + little(0U - 480, 4), 640, 480);
  const auto old = claim_of(head + little(12, 4) + little(640, 2) + little(480, 2));
  ASSERT_TRUE(old);
  EXPECT_EQ(old->height_px, 480U);
}

TEST(PictureClaim, PortableMaps) {
  expect_claim("P5\n# of a test\n 20000 #x\n 30000\n", 20'000, 30'000);
  EXPECT_FALSE(claim_of("P5 20000 99999999999 255\n"));
  EXPECT_FALSE(claim_of("P5 20000 -3 255\n  "));
  EXPECT_FALSE(claim_of("P9 20000 3 255\n  "));
  EXPECT_FALSE(claim_of("P5 #" + std::string(5000, 'x') + "\n3 3 255\n"));
}

TEST(PictureClaim, Webp) {
  const std::string head = "RIFF" + little(99, 4) + "WEBP";
  expect_claim(head + "VP8X" + std::string(8, '\0') + little(999, 3) + little(499, 3), 1000, 500);
  expect_claim(head + "VP8L" + little(50, 4) + "\x2f" + little(999U | 499U << 14U, 4), 1000, 500);
  expect_claim(
      head + "VP8 " + little(50, 4) + std::string(6, '\0') + little(1000, 2) + little(500, 2), 1000,
      500);
}

class TiffClaim : public testing::TestWithParam<bool> {
 protected:
  std::string number(std::uint32_t value, int count) const {
    return GetParam() ? little(value, count) : big(value, count);
  }
  std::string field(std::uint32_t tag, std::uint32_t value, std::uint32_t type = 4) const {
    return number(tag, 2) + number(type, 2) + number(1, 4) +
           (type == 3 ? number(value, 2) + number(0, 2) : number(value, 4));
  }
  std::string file(std::initializer_list<std::string> fields) const {
    std::string out = (GetParam() ? "II*\0"s : "MM\0*"s) + number(12, 4) + "pad!";
    out += number(static_cast<std::uint32_t>(fields.size()), 2);
    for (const std::string& f : fields) out += f;
    return out;
  }
};
INSTANTIATE_TEST_SUITE_P(ByteOrders, TiffClaim, testing::Bool());

TEST_P(TiffClaim, IsOfTheDirectory) {
  expect_claim(file({field(254, 0), field(256, 3000, 3), field(257, 70'000)}), 3000, 70'000);
  EXPECT_FALSE(claim_of(file({field(256, 3000)})));
  EXPECT_FALSE(claim_of(file({field(256, 3000), field(257, 2), field(257, 70'000)})));
  EXPECT_FALSE(claim_of(file({field(256, 3000), field(257, 2, 5)})));
}

// A decoder takes memory for whole strips and tiles.
TEST_P(TiffClaim, HoldsTilesAndStrips) {
  expect_claim(file({field(256, 30), field(257, 20), field(322, 1 << 16), field(323, 1 << 14)}), 30,
               20, 1 << 30);
  expect_claim(file({field(256, 30), field(257, 20), field(278, 1 << 20)}), 30, 20,
               30.0 * (1 << 20));
  expect_claim(file({field(256, 30), field(257, 20), field(278, 0xffffffff)}), 30, 20);
}

TEST(PictureClaim, NotOfWhatIsAlsoDicom) {
  const std::string webp =
      "RIFF" + little(99, 4) + "WEBPVP8L" + little(50, 4) + "\x2f" + little(999U | 499U << 14U, 4);
  const auto marked = [&](const std::string& mark) {
    return webp + std::string(128 - webp.size(), '\0') + mark;
  };
  EXPECT_TRUE(claim_of(marked("DICN")));
  EXPECT_FALSE(claim_of(marked("DICM")));
}

TEST(PictureClaim, NothingElse) {
  for (const std::string& other : {"GIF89a\1\0\1\0      "s, "v/1\1 OpenEXR     "s, ""s,
                                   "#?RADIANCE\n\n-Y 2 +X 4\n"s, "II+\0 BigTIFF      "s}) {
    EXPECT_FALSE(claim_of(other)) << other;
  }
}

}  // namespace
}  // namespace scattermeter::capture
