#include "core/diffusion/distance_bins.h"

#include <array>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Weights of one pair add up to the pair's weight, and a function linear between knots is exact:
// for the uniform bins linear in d, for the octave bins linear in d^2.
TEST(DistanceBins, UniformIsExactForLinearFunctions) {
  const UniformBins bins(0.35, 40.0);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> distance(0.0F, 40.0F);
  for (int i = 0; i < 1000; ++i) {
    const float d = i == 0 ? 0.0F : i == 1 ? 40.0F : distance(random);
    std::vector<double> sums(static_cast<std::size_t>(bins.size()));
    bins.add(d * d, 2.0F, sums.data());
    double total = 0.0, mean = 0.0;
    for (int k = 0; k < bins.size(); ++k) {
      total += sums[static_cast<std::size_t>(k)];
      mean += sums[static_cast<std::size_t>(k)] * bins.knot_mm(k);
    }
    EXPECT_NEAR(total, 2.0, 1e-6);
    EXPECT_NEAR(mean, 2.0 * static_cast<double>(d), 1e-5);
  }
}

TEST(DistanceBins, OctaveIsExactForLinearFunctionsOfTheSquare) {
  for (double resolution : {0.01, 0.3}) {
    const OctaveBins bins(resolution * resolution, 40.0, 6);
    EXPECT_LE(bins.s0_mm2(), resolution * resolution);
    EXPECT_GT(bins.s0_mm2(), 0.5 * resolution * resolution);
    EXPECT_DOUBLE_EQ(bins.knot_s_mm2(0), bins.s0_mm2());
    std::mt19937 random(2);
    std::uniform_real_distribution<float> distance(0.0F, 40.0F);
    for (int i = 0; i < 1000; ++i) {
      const float d = i == 0 ? 0.0F : i == 1 ? 40.0F : distance(random);
      std::vector<float> sums(static_cast<std::size_t>(bins.sums()));
      const std::array<float, 16> d2 = {d * d}, weight = {3.0F};
      bins.add(d2.data(), weight.data(), 1, sums.data());
      double total = 0.0, mean = 0.0;
      for (int k = 0; k < bins.size(); ++k) {
        const auto sum = static_cast<double>(OctaveBins::of_knot(sums.data(), k));
        total += sum;
        mean += sum * bins.knot_s_mm2(k);
      }
      const double s = static_cast<double>(d) * static_cast<double>(d) + bins.s0_mm2();
      EXPECT_NEAR(total, 3.0, 1e-6);
      EXPECT_NEAR(mean, 3.0 * s, 1e-6 * 3.0 * s);
    }
  }
}

// Knots grow by at most 2^-bits of themselves.
TEST(DistanceBins, OctaveStepsAreRelative) {
  const OctaveBins bins(0.001, 100.0, 6);
  for (int i = 0; i + 1 < bins.size(); ++i) {
    const double step = bins.knot_s_mm2(i + 1) - bins.knot_s_mm2(i);
    EXPECT_GT(step, 0.0);
    EXPECT_LE(step, bins.knot_s_mm2(i) / 64.0);
  }
}

}  // namespace
}  // namespace scattermeter
