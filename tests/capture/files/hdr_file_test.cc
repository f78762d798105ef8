#include "capture/files/hdr_file.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/capture/probe_bytes.h"

namespace scattermeter::capture {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

ProbeImage random_probe(int width, int height) {
  ProbeImage image{width, height, {}};
  std::mt19937 random(2);
  std::uniform_real_distribution<float> exponent(-6.0F, 17.0F);
  for (int i = 0; i < width * height; ++i) {
    const float level = i % 5 < 3 ? 1.0F : std::exp2(exponent(random));  // some runs
    for (float c : {1.0F, 0.7F, 0.3F}) image.radiance.push_back(level * c);
  }
  return image;
}

std::string hdr_refusal(const std::string& bytes, const ProbeLimits& limits = {}) {
  try {
    decode_hdr("p.hdr", bytes, limits);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(HdrFile, ReadsRunsAndFlatRows) {
  const ProbeImage image = random_probe(37, 19);
  for (const bool run_length : {true, false}) {
    const std::string bytes = hdr_bytes(image, run_length);
    ASSERT_TRUE(is_hdr(bytes));
    const ProbeImage read = decode_hdr("p.hdr", bytes, {});
    ASSERT_EQ(read.width_px, 37);
    ASSERT_EQ(read.height_px, 19);
    ASSERT_EQ(read.radiance.size(), image.radiance.size());
    for (std::size_t i = 0; i < image.radiance.size(); i += 3) {
      // A pixel's channels share an exponent: steps of 1/256 .. 1/128 of its brightest.
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(read.radiance[i + c], image.radiance[i + c], image.radiance[i] / 128.0F);
      }
    }
  }
}

// Wherever the file ends, it is refused: no row is made up.
TEST(HdrFile, RefusesEveryTruncation) {
  for (const bool run_length : {true, false}) {
    const std::string bytes = hdr_bytes(random_probe(21, 5), run_length);
    for (std::size_t n = 11; n < bytes.size(); ++n) {
      EXPECT_THAT(hdr_refusal(bytes.substr(0, n)), AllOf(HasSubstr("p.hdr: "))) << n;
    }
    EXPECT_EQ(hdr_refusal(bytes), "");
  }
}

// Mantissa over 256 times two to the exponent byte less 128; an exponent of 0 is black.
TEST(HdrFile, ValuesAreTheFormats) {
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 3\n";
  const std::string pixels("\x80\x40\x01\x81\xff\xff\xff\x00\xff\x00\x80\xff", 12);
  const ProbeImage read = decode_hdr("p.hdr", head + pixels, {});
  const float largest = 1.7014118e38F;  // 2^127
  EXPECT_EQ(read.radiance, (std::vector<float>{1.0F, 0.5F, 1 / 128.0F, 0, 0, 0,
                                               255.0F / 256 * largest, 0, 0.5F * largest}));
  EXPECT_THAT(hdr_refusal("#?RADIANCE\n\n-Y 1 +X 3\n" + pixels), HasSubstr("names no FORMAT"));
}

TEST(HdrFile, RefusesDamagedRuns) {
  std::string bytes = hdr_bytes(random_probe(21, 5));
  const std::size_t first_row = bytes.find("+X 21\n") + 6;
  bytes[first_row + 4] = static_cast<char>(128 + 100);  // a run past the end of the row
  EXPECT_THAT(hdr_refusal(bytes), HasSubstr("truncated or damaged"));
}

TEST(HdrFile, RefusesWhatItCannotRead) {
  const std::string bytes = hdr_bytes(random_probe(21, 5));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = bytes;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_THAT(hdr_refusal(with("rle_rgbe", "rle_xyze")), HasSubstr("32-bit_rle_xyze is not read"));
  EXPECT_THAT(hdr_refusal(with("-Y 5 +X", "+Y 5 +X")), HasSubstr("\"+Y 5 +X 21\""));
  EXPECT_THAT(hdr_refusal(with("-Y 5 +X", "-Y 0 +X")), HasSubstr("\"-Y 0 +X 21\""));
  EXPECT_THAT(hdr_refusal(with("-Y 5 +X 21", "-Y 90000 +X 90000")), HasSubstr("90000 x 90000"));
  EXPECT_THAT(hdr_refusal(bytes, {100}), AllOf(HasSubstr("21 x 5"), HasSubstr("at most 100")));
}

}  // namespace
}  // namespace scattermeter::capture
