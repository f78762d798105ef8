#include "calib/pose/edge_strip.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

// A half plane at `offset` along `normal` from (20, 20), its brightness falling by `slope` a pixel
// from the edge inwards, by 32 x 32 points a pixel.
CfaSamples half_plane(const Eigen::Vector2d& normal, double offset, double counts, double slope,
                      std::mt19937_64* random) {
  CfaSamples s;
  s.width = s.height = 41;
  s.channel_of_phase = {0, 1, 1, 2};
  s.variance_per_count = 1.0 / 6;
  std::normal_distribution<double> gauss;
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) {
      const double colour = s.channel(x, y) == 0 ? 0.6 : s.channel(x, y) == 1 ? 1.0 : 0.8;
      double signal = 0;
      for (int i = 0; i < 32 * 32; ++i) {
        const Eigen::Vector2d p(x + (i % 32 + 0.5) / 32 - 20.5, y + (i / 32 + 0.5) / 32 - 20.5);
        const double t = offset - p.dot(normal);
        if (t > 0) signal += colour * counts * (1 + slope * t) / 1024;
      }
      const double noise = random == nullptr ? 0 : std::sqrt(1.4 + signal / 6) * gauss(*random);
      s.signal_counts.push_back(static_cast<float>(signal + noise));
      s.variance_counts2.push_back(static_cast<float>(1.4 + std::max(0.0, signal + noise) / 6));
      s.clipped.push_back(0);
    }
  }
  return s;
}

TEST(EdgeStrip, FindsTheEdgeToAHundredth) {
  for (const double angle : {0.0, 0.03, 0.4, 0.785, 1.5708, 2.5, -1.1}) {
    const Eigen::Vector2d normal(std::cos(angle), std::sin(angle));
    for (const double offset : {-0.37, 0.0, 0.21}) {
      for (const double slope : {0.0, 0.05}) {
        const EdgeStrip e =
            locate_edge(half_plane(normal, offset, 1000, slope, nullptr), {20, 20}, normal);
        ASSERT_TRUE(e.found) << angle << " " << offset;
        EXPECT_NEAR(e.offset_px, offset, 0.01) << angle << " " << slope;
      }
    }
  }
}

// Over noise: no bias, and the deviation that is predicted.
TEST(EdgeStrip, KnowsItsUncertainty) {
  const Eigen::Vector2d normal(std::cos(0.4), std::sin(0.4));
  double sum = 0, squares = 0, predicted = 0;
  constexpr int kSeeds = 60;
  EdgeStripOptions options;
  options.blur_px = 0.05;
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const EdgeStrip e =
        locate_edge(half_plane(normal, 0.21, 300, 0.02, &random), {20, 20}, normal, options);
    ASSERT_TRUE(e.found);
    sum += e.offset_px - 0.21;
    squares += std::pow(e.offset_px - 0.21, 2);
    predicted += e.std_px * e.std_px;
  }
  const double sampled = std::sqrt(squares / kSeeds - std::pow(sum / kSeeds, 2));
  EXPECT_LT(std::abs(sum / kSeeds), 4.5 * sampled / std::sqrt(kSeeds));
  // 60 draws tell a deviation to 9 %; std_px may only be widened by a misfit, by some 5 % here.
  EXPECT_NEAR(std::sqrt(predicted / kSeeds) / sampled, 1, 0.3);
}

TEST(EdgeStrip, SaysWhereThereIsNone) {
  const Eigen::Vector2d normal(1, 0);
  CfaSamples s = half_plane(normal, 0.2, 1000, 0, nullptr);
  EXPECT_FALSE(locate_edge(s, {20, 20}, -normal).found);  // bright outside
  EXPECT_FALSE(locate_edge(s, {3, 20}, normal).found);    // out of the picture
  s.clipped[20 * 41 + 18] = 1;
  EXPECT_FALSE(locate_edge(s, {20, 20}, normal).found);
  std::mt19937_64 random(1);
  EXPECT_FALSE(locate_edge(half_plane(normal, 0.2, 0, 0, &random), {20, 20}, normal).found);
  EXPECT_THROW(locate_edge(s, {20, 20}, {2, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
