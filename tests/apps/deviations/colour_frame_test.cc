#include "apps/deviations/colour_frame.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

// A point of 1000 counts in the middle of G.
ColourFrame point() {
  ColourFrame frame = black_frame(41, 31, 4000.0);
  frame.object = {10, 10, 20, 10};
  frame.at(1, 20, 15) = 1000.0F;
  return frame;
}

double sum(const ColourFrame& frame, std::size_t channel) {
  return mean_counts(frame, channel) * 41 * 31;
}

TEST(ColourFrame, BlurKeepsTheSumAndHasItsWidth) {
  ColourFrame frame = point();
  blur(frame, 2.0);
  EXPECT_NEAR(sum(frame, 1), 1000.0, 0.1);
  EXPECT_EQ(sum(frame, 0), 0.0);
  EXPECT_NEAR(frame.at(1, 20, 15), 1000.0 / (2.0 * 3.14159265 * 4.0), 0.2);
  EXPECT_NEAR(frame.at(1, 22, 15) / frame.at(1, 20, 15), std::exp(-0.5), 1e-3);
  EXPECT_NEAR(frame.at(1, 20, 17), frame.at(1, 22, 15), 1e-3);
}

TEST(ColourFrame, SmearCoversItsLength) {
  ColourFrame frame = point();
  smear(frame, 4.0);
  EXPECT_NEAR(sum(frame, 1), 1000.0, 0.1);
  for (int x = 19; x <= 21; ++x) EXPECT_NEAR(frame.at(1, x, 15), 250.0, 1e-3);
  EXPECT_NEAR(frame.at(1, 18, 15), 125.0, 1e-3);
  EXPECT_EQ(frame.at(1, 17, 15), 0.0F);
  EXPECT_EQ(frame.at(1, 20, 16), 0.0F);
  ColourFrame little = point();
  smear(little, 0.8);
  EXPECT_NEAR(little.at(1, 19, 15), 100.0, 0.01);  // 0.8 / 8
  EXPECT_NEAR(little.at(1, 20, 15), 800.0, 0.01);
}

TEST(ColourFrame, Discs) {
  ColourFrame frame = black_frame(41, 31, 4000.0);
  frame.object = {10, 10, 20, 10};
  add_disc(frame, 0.5, 0.5, 6.0, 100.0);
  EXPECT_NEAR(sum(frame, 2), 100.0 * 3.14159265 * 36.0, 100.0);
  multiply_disc(frame, 0.5, 0.5, 2.0, 0.25);
  EXPECT_NEAR(frame.at(0, 20, 15), 25.0, 1e-3);
  EXPECT_NEAR(frame.at(0, 24, 15), 100.0, 1e-3);
  add_disc(frame, -0.6, 0.5, 6.0, 100.0);  // partly beyond the frame
  EXPECT_NEAR(frame.at(1, 0, 15), 100.0, 1e-3);
}

TEST(ColourFrame, CountsExceeded) {
  ColourFrame frame = black_frame(20, 10, 4000.0);
  EXPECT_EQ(counts_exceeded(frame, 0.0), 0.0);
  for (std::size_t k = 0; k < 100; ++k) frame.counts[1][2 * k] = static_cast<float>(k + 1);
  frame.counts[2][7] = 50.0F;
  EXPECT_EQ(counts_exceeded(frame, 0.0), 100.0);
  EXPECT_EQ(counts_exceeded(frame, 0.1), 90.0);  // 91 to 100 are more
  frame.counts[0][7] = 95.0F;
  EXPECT_EQ(counts_exceeded(frame, 0.1), 95.0);
}

TEST(ColourFrame, ScalesAndMosaic) {
  ColourFrame frame = point();
  scale_frame(frame, 0.5);
  scale_channel(frame, 1, 3.0);
  EXPECT_NEAR(counts_exceeded(frame, 0.0), 1500.0, 1e-3);
  for (std::size_t c = 0; c < 3; ++c) {
    for (float& counts : frame.counts[c]) counts = static_cast<float>(c + 1);
  }
  const std::vector<float> raw = mosaic(frame, cfa_pattern_from_name("GBRG"));
  EXPECT_EQ(raw[0], 2.0F);
  EXPECT_EQ(raw[1], 3.0F);
  EXPECT_EQ(raw[41], 1.0F);
  EXPECT_EQ(raw[42], 2.0F);
}

}  // namespace
}  // namespace scattermeter::apps
