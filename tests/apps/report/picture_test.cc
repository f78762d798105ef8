#include "apps/report/picture.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(Picture, PngHasItsSignatureAndSize) {
  const std::string png = png_bytes(Picture(300, 2, {200, 100, 0}));
  ASSERT_GT(png.size(), 24U);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(static_cast<unsigned char>(png[18]) * 256 + static_cast<unsigned char>(png[19]), 300);
  EXPECT_THROW(png_bytes(Picture(0, 0, {0, 0, 0})), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
