#include "calib/radiance/frame_blocks.h"

#include <random>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

TEST(FrameBlocks, CoverEverySampleOnce) {
  std::vector<int> met(38 * 26, 0);
  for (const Block& b : blocks_of_frame(38, 26, 5, 3)) {
    for (int y = b.y0; y < b.y1; y += 2) {
      for (int x = b.x0; x < b.x1; x += 2) {
        EXPECT_EQ(b.phase, 2 * (y & 1) + (x & 1));
        ++met[static_cast<std::size_t>(y * 38 + x)];
      }
    }
  }
  EXPECT_EQ(std::set<int>(met.begin(), met.end()), std::set<int>{1});
  EXPECT_THROW(blocks_of_frame(8, 8, 5, 2), std::invalid_argument);
}

TEST(FrameBlocks, MeansSubtractBlackOfThePhaseAndLeaveMarksOut) {
  std::vector<std::uint16_t> samples(16 * 8, 100);
  std::vector<std::uint8_t> marks(samples.size(), 0);
  samples[2] = 60000;  // a defect in the first block of phase 0
  marks[2] = 2;
  samples[9] = 4095;  // clipped: phase 1 of the second rectangle
  marks[9] = 1;
  const std::vector<Block> blocks = blocks_of_frame(16, 8, 2, 1);
  const auto means = block_means(samples, marks, 16, {10, 20, 30, 40}, blocks);
  ASSERT_EQ(means.size(), 8U);
  EXPECT_EQ(means[0].counts, 90);
  EXPECT_EQ(means[0].n, 15);
  EXPECT_EQ(means[3].counts, 60);
  EXPECT_EQ(means[5].n, 0);
}

// The difference of a pair is blind to the pattern that both share, and to a step in level.
TEST(FrameBlocks, PairVarianceIsTheNoiseAlone) {
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal;
  const int width = 200, height = 200;
  std::vector<std::uint16_t> a, b;
  for (int i = 0; i < width * height; ++i) {
    const double pattern = 1000 + 2 * (i % width) + 300 * (i % 7 == 0);
    a.push_back(static_cast<std::uint16_t>(std::lround(pattern + 5 * normal(generator))));
    b.push_back(static_cast<std::uint16_t>(std::lround(pattern + 40 + 5 * normal(generator))));
  }
  const std::vector<std::uint8_t> marks(a.size(), 0);
  const auto pairs =
      pair_variances(a, b, marks, width, {0, 0, 0, 0}, blocks_of_frame(width, height, 2, 2));
  double sum = 0;
  for (const PairVariance& p : pairs) sum += p.variance_counts2 / static_cast<double>(pairs.size());
  // 40000 samples: the variance scatters by 0.7 %; rounding adds 1/12.
  EXPECT_NEAR(sum, 25.0 + 1.0 / 12, 4 * 0.007 * 25);
}

TEST(FrameBlocks, RefusesMarksOfAnotherFrame) {
  const std::vector<std::uint16_t> samples(64, 1);
  const std::vector<std::uint8_t> marks(60, 0);
  EXPECT_THROW(block_means(samples, marks, 8, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
