#include "capture/files/exr_file.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/capture/probe_bytes.h"

namespace scattermeter::capture {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

ProbeImage ramp(int width, int height) {
  ProbeImage image{width, height, {}};
  for (int i = 0; i < 3 * width * height; ++i) {
    image.radiance.push_back(std::exp2(static_cast<float>(i % 29) - 14.0F) * 1.37F);
  }
  return image;
}

std::string exr_refusal(const std::string& bytes, const ProbeLimits& limits = {}) {
  try {
    decode_exr("p.exr", bytes, limits);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ExrFile, ReadsFloatExactlyAndHalfToItsDigits) {
  const ProbeImage image = ramp(23, 11);
  const std::string bytes = exr_bytes(image, ExrType::kFloat);
  ASSERT_TRUE(is_exr(bytes));
  const ProbeImage read = decode_exr("p.exr", bytes, {});
  EXPECT_EQ(read.width_px, 23);
  EXPECT_EQ(read.height_px, 11);
  EXPECT_EQ(read.radiance, image.radiance);
  const ProbeImage half = decode_exr("p.exr", exr_bytes(image, ExrType::kHalf), {});
  for (std::size_t i = 0; i < image.radiance.size(); ++i) {
    EXPECT_NEAR(half.radiance[i], image.radiance[i], image.radiance[i] / 2048.0F);
  }
}

TEST(ExrFile, WritesWhatItReads) {
  const ProbeImage image = ramp(37, 21);
  const std::string bytes = encode_exr(image, {{"unit", "W/(mm^2 sr)"}});
  ASSERT_TRUE(is_exr(bytes));
  EXPECT_THAT(bytes, HasSubstr("W/(mm^2 sr)"));
  const ProbeImage read = decode_exr("p.exr", bytes, {});
  EXPECT_EQ(read.width_px, 37);
  EXPECT_EQ(read.height_px, 21);
  EXPECT_EQ(read.radiance, image.radiance);
  EXPECT_THROW(encode_exr({2, 2, {1.0F}}, {}), std::invalid_argument);
  EXPECT_THROW(encode_exr({0, 0, {}}, {}), std::invalid_argument);
}

TEST(ExrFile, RefusesTruncationAnywhere) {
  const std::string bytes = exr_bytes(ramp(23, 40), ExrType::kHalf);
  for (std::size_t n = 4; n < bytes.size(); n += 7) {
    const std::string said = exr_refusal(bytes.substr(0, n));
    EXPECT_THAT(said, AllOf(HasSubstr("p.exr: "), HasSubstr("truncated"))) << n;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
}

TEST(ExrFile, RefusesOtherChannels) {
  EXPECT_THAT(exr_refusal(exr_bytes(ramp(4, 4), ExrType::kHalf, "RG")), HasSubstr("no channel B"));
  EXPECT_THAT(exr_refusal(exr_bytes(ramp(4, 4), ExrType::kHalf, "Y")), HasSubstr("no channel R"));
  EXPECT_THAT(exr_refusal(exr_bytes(ramp(4, 4), ExrType::kUint)),
              HasSubstr("channel R must be half"));
  EXPECT_EQ(exr_refusal(exr_bytes(ramp(4, 4), ExrType::kHalf, "RGBA")), "");
}

TEST(ExrFile, RefusesTooManyPixels) {
  EXPECT_THAT(exr_refusal(exr_bytes(ramp(20, 10), ExrType::kHalf), {199}),
              AllOf(HasSubstr("20 x 10"), HasSubstr("at most 199")));
}

}  // namespace
}  // namespace scattermeter::capture
