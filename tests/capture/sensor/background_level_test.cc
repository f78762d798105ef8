#include "capture/sensor/background_level.h"

#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

// Noise about black + level, the same everywhere but for a bright object.
RawFrame level_frame(double level_counts, std::uint64_t seed) {
  RawFrame f;
  f.width_px = 320;
  f.height_px = 240;
  f.black_counts = {64, 64, 64, 64};
  f.white_counts = 4095;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int y = 0; y < f.height_px; ++y) {
    for (int x = 0; x < f.width_px; ++x) {
      const bool object = x >= 100 && x < 200 && y >= 80 && y < 160;
      f.samples.push_back(
          static_cast<std::uint16_t>(64.5 + level_counts + (object ? 2000.0 : noise(random))));
    }
  }
  return f;
}

TEST(BackgroundLevel, SeesBlackBesideTheObject) {
  const BackgroundLevel b = background_level(level_frame(0.0, 1), 100, 80, 100, 80);
  // 20 x 15 blocks of 16; columns 6 to 12 and rows 5 to 9 touch the object.
  EXPECT_EQ(b.block_px, 16);
  EXPECT_EQ(b.blocks, 20U * 15U - 7U * 5U);
  for (std::size_t c = 0; c < kChannels; ++c) {
    // 64 red samples of 1.5 counts and rounding.
    EXPECT_NEAR(b.block_std_counts[c], 1.53 / (c == 1 ? 11.3 : 8.0), 0.03);
    EXPECT_NEAR(b.median_counts[c], 0.0, 0.06);
    EXPECT_NEAR(b.darkest_counts[c], -1.28 * b.block_std_counts[c], 0.08);
  }
}

TEST(BackgroundLevel, SeesVeilingLight) {
  const BackgroundLevel b = background_level(level_frame(3.0, 2), 100, 80, 100, 80);
  for (std::size_t c = 0; c < kChannels; ++c) EXPECT_NEAR(b.darkest_counts[c], 2.8, 0.15);
}

TEST(BackgroundLevel, SeesLightBesideTheObject) {
  RawFrame f = level_frame(0.0, 5);
  const BackgroundLevel even = background_level(f, 100, 80, 100, 80);
  // About the 7 x 5 blocks that touch the object, a ring of others.
  EXPECT_EQ(even.blocks_beside, 9U * 7U - 7U * 5U);
  for (std::size_t c = 0; c < kChannels; ++c) EXPECT_NEAR(even.beside_counts[c], 0.0, 0.1);
  for (int y = 60; y < 180; ++y) {
    for (int x = 80; x < 220; ++x) f.samples[static_cast<std::size_t>(y * f.width_px + x)] += 4;
  }
  const BackgroundLevel lit = background_level(f, 100, 80, 100, 80);
  for (std::size_t c = 0; c < kChannels; ++c) {
    EXPECT_NEAR(lit.beside_counts[c], 4.0, 0.8);
    EXPECT_NEAR(lit.darkest_counts[c], even.darkest_counts[c], 0.1);
  }
}

TEST(BackgroundLevel, NothingBesideTheObject) {
  EXPECT_EQ(background_level(level_frame(0.0, 3), 0, 0, 320, 240).blocks, 0U);
  RawFrame empty = level_frame(0.0, 4);
  empty.samples.pop_back();
  EXPECT_THROW(background_level(empty, 0, 0, 1, 1), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
