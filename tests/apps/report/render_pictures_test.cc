#include "apps/report/render_pictures.h"

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

TEST(RenderPictures, ScreenValues) {
  EXPECT_EQ(srgb_byte(-1.0), 0);
  EXPECT_EQ(srgb_byte(1.0), 255);
  EXPECT_EQ(srgb_byte(7.0), 255);
  // IEC 61966-2-1: 0.5 of the encoded range is a linear 0.214041; the straight part ends at 10.3.
  EXPECT_EQ(srgb_byte(0.214041 * 1.001), 128);
  EXPECT_EQ(srgb_byte(0.0031308), 10);
  Rendering rendering;
  rendering.scenes = {{"cube", {"led"}}};
  RenderedPicture picture;
  picture.radiance.width = 1000;
  picture.radiance.height = 2;
  // 1000 pixels lit by 1 .. 1000 in green, the others dark: 2 of them are brighter than 998.
  for (int i = 0; i < 2000; ++i) {
    for (float v : {0.5F, static_cast<float>(i + 1), 0.25F}) {
      picture.radiance.rgb.push_back(i < 1000 ? v : 0.0F);
    }
  }
  rendering.pictures = {picture};
  EXPECT_EQ(white_radiance(rendering), 998.0);
  const Picture shown = srgb_picture(picture.radiance, 998.0);
  EXPECT_EQ(shown.at(997, 0)[1], 255);
  EXPECT_EQ(shown.at(3, 1), (PictureColour{0, 0, 0}));
  EXPECT_LE(contact_sheet(rendering, {"POM"}, 998.0, 400).width_px, 400);
}

}  // namespace
}  // namespace scattermeter::apps
