#include "capture/raw/raw_metadata.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

std::string refusal(int width_px, int height_px, const std::vector<std::uint16_t>& codes,
                    const RawMetadata& metadata = {}) {
  try {
    check_raw("writer", width_px, height_px, codes, metadata);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(RawMetadata, DefaultsCanBeWritten) {
  EXPECT_EQ(refusal(4, 2, std::vector<std::uint16_t>(8, 4095)), "");
}

TEST(RawMetadata, RefusalsNameTheCallerAndTheValue) {
  const std::vector<std::uint16_t> codes(8, 7);
  EXPECT_EQ(refusal(4, 3, codes),
            "writer: sides must be positive, even and at most 65530, got 4 x 3");
  EXPECT_EQ(refusal(4, 4, codes), "writer: 4 x 4 samples expected, got 8");
  EXPECT_EQ(refusal(4, 2, std::vector<std::uint16_t>(8, 4096)),
            "writer: code 4096 is above the largest allowed, 4095");
  RawMetadata metadata;
  metadata.linearization_table = {0, 1, 2};
  EXPECT_EQ(refusal(4, 2, codes, metadata), "writer: code 7 is above the largest allowed, 2");
  metadata = {};
  metadata.iso = 65535;
  EXPECT_EQ(refusal(4, 2, codes, metadata), "writer: iso must lie in 1 .. 65534, got 65535");
}

}  // namespace
}  // namespace scattermeter::capture
