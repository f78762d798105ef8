#include "calib/board/tone_picture.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

TEST(TonePicture, StretchesWithoutRegardToAFewHotSamples) {
  std::vector<float> image;
  for (int i = 0; i < 1000; ++i) image.push_back(100.0F + static_cast<float>(i % 101));
  image[5] = 1e9F;
  image[6] = std::nanf("");
  const cv::Mat_<float> m = stretched_image(image, 100, 10);
  EXPECT_NEAR(m(0, 50), 0.5F, 0.02F);
  EXPECT_EQ(m(0, 6), 0);
  EXPECT_EQ(to_8_bit(m, gamma_curve)(0, 5), 255);
  EXPECT_TRUE(stretched_image(std::vector<float>(100, 3.0F), 10, 10).empty());
}

TEST(TonePicture, CurvesRunFromZeroToOne) {
  for (float (*curve)(float) : {&gamma_curve, &steep_curve}) {
    EXPECT_EQ(curve(0), 0);
    EXPECT_FLOAT_EQ(curve(1), 1);
    EXPECT_GT(curve(0.1F), 0.3F);
  }
  EXPECT_GT(steep_curve(0.01F), gamma_curve(0.01F));
}

}  // namespace
}  // namespace scattermeter::calib
