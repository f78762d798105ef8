#include "apps/report/picture.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(Picture, SideBySideOnACommonHeight) {
  Picture a(2, 3, {1, 2, 3});
  a.set(1, 2, {9, 8, 7});
  const Picture b(4, 1, {4, 5, 6});
  const Picture both = side_by_side({a, b}, 2);
  EXPECT_EQ(both.width_px, 8);
  EXPECT_EQ(both.height_px, 3);
  EXPECT_EQ(both.at(1, 2), (PictureColour{9, 8, 7}));
  EXPECT_EQ(both.at(2, 0), (PictureColour{255, 255, 255}));
  EXPECT_EQ(both.at(4, 0), (PictureColour{4, 5, 6}));
}

TEST(Picture, PngHasItsSignatureAndSize) {
  const std::string png = png_bytes(Picture(300, 2, {200, 100, 0}));
  ASSERT_GT(png.size(), 24U);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(static_cast<unsigned char>(png[18]) * 256 + static_cast<unsigned char>(png[19]), 300);
  EXPECT_THROW(png_bytes(Picture(0, 0, {0, 0, 0})), std::invalid_argument);
}

TEST(Picture, Colours) {
  EXPECT_EQ(grey_colour(0.25), (PictureColour{128, 128, 128}));
  EXPECT_EQ(grey_colour(7.0), (PictureColour{255, 255, 255}));
  EXPECT_EQ(difference_colour(0.0), (PictureColour{255, 255, 255}));
  EXPECT_GT(difference_colour(0.5)[0], difference_colour(0.5)[2]);
  EXPECT_LT(difference_colour(-0.5)[0], difference_colour(-0.5)[2]);
}

}  // namespace
}  // namespace scattermeter::apps
