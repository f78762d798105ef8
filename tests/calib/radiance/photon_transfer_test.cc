#include "calib/radiance/photon_transfer.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

// Variances as chi-square draws around the truth.
std::vector<NoisePoint> points_of(double gain, double read, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<NoisePoint> out;
  for (int level = 0; level < 12; ++level) {
    for (int block = 0; block < 20; ++block) {
      NoisePoint p;
      p.counts = 300.0 * level + block;
      p.quantisation_counts2 = 1.0 / 12;
      p.degrees_of_freedom = 60;
      const double truth = p.counts / gain + read * read + 1.0 / 12;
      p.variance_counts2 = truth * std::chi_squared_distribution<double>(60)(generator) / 60;
      out.push_back(p);
    }
  }
  return out;
}

TEST(PhotonTransfer, IsExactWithoutScatter) {
  std::vector<NoisePoint> points;
  for (const double counts : {0.0, 100.0, 1000.0, 3000.0}) {
    points.push_back({counts, counts / 5 + 1.44 + 0.3, 0.3, 1000});
  }
  const PhotonTransfer fit = fit_photon_transfer(points);
  ASSERT_TRUE(fit.ok);
  EXPECT_NEAR(fit.gain_e_per_count, 5.0, 1e-9);
  EXPECT_NEAR(fit.read_noise_counts, 1.2, 1e-9);
}

// 200 draws: the mean within four of its own standard deviations, the scatter as predicted to 20 %
// (a standard deviation from 200 draws scatters by 5 %).
TEST(PhotonTransfer, IsUnbiasedAndKnowsItsScatter) {
  double sum = 0, squares = 0, predicted = 0, read = 0;
  constexpr int kDraws = 200;
  for (int i = 0; i < kDraws; ++i) {
    const PhotonTransfer fit =
        fit_photon_transfer(points_of(6.0, 1.2, static_cast<std::uint64_t>(i)));
    ASSERT_TRUE(fit.ok);
    const double d = fit.gain_e_per_count - 6.0;
    sum += d / kDraws;
    squares += d * d / kDraws;
    predicted += fit.gain_std / kDraws;
    read += fit.read_noise_counts / kDraws;
  }
  const double scatter = std::sqrt(squares - sum * sum);
  EXPECT_NEAR(sum, 0.0, 4 * scatter / std::sqrt(kDraws) + 0.002);
  EXPECT_NEAR(predicted / scatter, 1.0, 0.2);
  EXPECT_NEAR(read, 1.2, 0.02);
}

TEST(PhotonTransfer, SaysWhereThereIsNoGain) {
  EXPECT_FALSE(fit_photon_transfer({}).ok);
  EXPECT_FALSE(fit_photon_transfer({{0, 1, 0, 100}, {100, 20, 0, 100}}).ok);
  // Noise that does not grow: no light, or a frame twice.
  EXPECT_FALSE(
      fit_photon_transfer({{0, 1, 0, 100}, {100, 1, 0, 100}, {1000, 1, 0, 100}, {2000, 1, 0, 9}})
          .ok);
}

}  // namespace
}  // namespace scattermeter::calib
