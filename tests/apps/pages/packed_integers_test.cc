#include "apps/pages/packed_integers.h"

#include <gtest/gtest.h>

#include "apps/pages/base64.h"

namespace scattermeter::apps {
namespace {

// Deflated and with Adler's sum (by Python's zlib at level 4).
TEST(PackedIntegers, PlanesOfLowAndHighBytes) {
  // 1, -2, 0x1234 in two bytes: 01 fe 34, then 00 ff 12.
  EXPECT_EQ(packed_integers({1, -2, 0x1234}, 2), "eF5j/GfC8F8IAAfiAkU=");
  EXPECT_EQ(packed_integers({}, 2), "eF4DAAAAAAE=");
}

TEST(PackedIntegers, WhatRepeatsIsShort) {
  EXPECT_LT(packed_integers(std::vector<std::int32_t>(100'000, 70'000), 3).size(), 1'000U);
}

}  // namespace
}  // namespace scattermeter::apps
