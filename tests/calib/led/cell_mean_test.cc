#include "calib/led/cell_mean.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

// A square grid of n x n positions, 0.1 mm apart, with the signal 100 + 3 x - 2 y and noise.
std::vector<PlaneSample> trend(int n, double noise, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<PlaneSample> samples;
  for (int i = 0; i < n * n; ++i) {
    const double x = 0.1 * (i % n), y = 0.1 * (i / n);
    samples.push_back({static_cast<float>(x), static_cast<float>(y),
                       static_cast<float>(100 + 3 * x - 2 * y + noise * normal(generator)),
                       static_cast<float>(noise * noise)});
  }
  return samples;
}

TEST(CellMean, IsThatOfItsSamples) {
  const auto mean = robust_cell_mean(trend(11, 1e-3, 1), 0.2);
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->spots, 0U);
  EXPECT_NEAR(mean->position_mm.x(), 0.5, 1e-6);
  EXPECT_NEAR(mean->position_mm.y(), 0.5, 1e-6);
  // Variance of 11 evenly spaced positions: h^2 (n^2 - 1) / 12.
  EXPECT_NEAR(mean->spread_mm2(0, 0), 0.1, 1e-6);
  EXPECT_NEAR(mean->spread_mm2(0, 1), 0.0, 1e-6);
  EXPECT_NEAR(mean->signal_counts, 100.5, 4e-4);
  EXPECT_NEAR(mean->variance_counts2, 1e-6 / 121, 1e-12);
}

TEST(CellMean, DustIsLeftOutAndATrendIsNoDust) {
  std::vector<PlaneSample> samples = trend(11, 0.01, 2);
  for (const std::size_t i : {7U, 30U, 31U, 90U}) samples[i].signal_counts = 20.0F;
  samples[60].signal_counts = 1e6F;
  const auto mean = robust_cell_mean(samples, 0.2);
  ASSERT_TRUE(mean);
  EXPECT_EQ(mean->spots, 5U);
  EXPECT_NEAR(mean->signal_counts, 100 + 3 * mean->position_mm.x() - 2 * mean->position_mm.y(),
              0.004);
}

TEST(CellMean, NoneOfTooLittle) {
  EXPECT_FALSE(robust_cell_mean({}, 0.2));
  std::vector<PlaneSample> samples = trend(4, 0.01, 3);
  ASSERT_TRUE(robust_cell_mean(samples, 0.2));
  samples.resize(kLeastCellSamples - 1);
  EXPECT_FALSE(robust_cell_mean(samples, 0.2));
  // A quarter dust, where a fifth is the limit.
  samples = trend(8, 0.01, 4);
  for (std::size_t i = 0; i < 16; ++i) samples[4 * i].signal_counts += 30.0F;
  EXPECT_FALSE(robust_cell_mean(samples, 0.2));
  EXPECT_TRUE(robust_cell_mean(samples, 0.3));
}

}  // namespace
}  // namespace scattermeter::calib
