#include "calib/radiance/dark_fit.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

DarkFrame frame_of(double exposure_s, double black, double rate, double std) {
  DarkFrame f;
  f.exposure_s = exposure_s;
  for (std::size_t p = 0; p < 4; ++p) {
    f.mean_counts[p] = black + static_cast<double>(p) + rate * exposure_s;
    f.std_of_mean[p] = std;
  }
  return f;
}

TEST(DarkFit, FindsBlackAndRatePerPhase) {
  const DarkFit fit = fit_dark({frame_of(0.1, 64, 3, 0.01), frame_of(1, 64, 3, 0.01),
                                frame_of(4, 64, 3, 0.01), frame_of(2, 64, 3, 0.01)});
  EXPECT_TRUE(fit.rate_known);
  EXPECT_TRUE(fit.scatter_known);
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_NEAR(fit.black_counts[p], 64.0 + static_cast<double>(p), 1e-9);
    EXPECT_NEAR(fit.dark_counts_per_s[p], 3.0, 1e-9);
  }
  EXPECT_LT(fit.black_std_counts, 0.01);
  EXPECT_LT(fit.worst_counts, 1e-9);
}

TEST(DarkFit, FramesThatDifferWidenTheBlack) {
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal(0.0, 0.5);
  std::vector<DarkFrame> frames;
  for (int i = 0; i < 40; ++i) frames.push_back(frame_of(0.1, 64 + normal(generator), 0, 0.01));
  const DarkFit fit = fit_dark(frames);
  EXPECT_FALSE(fit.rate_known);
  EXPECT_EQ(fit.dark_counts_per_s[0], 0.0);
  EXPECT_NEAR(fit.black_std_counts, 0.5, 4 * 0.5 / std::sqrt(80.0));
  EXPECT_THROW(fit_dark({}), std::invalid_argument);
}

class DarkPixels : public ::testing::Test {
 protected:
  DarkPixels() : samples_(kWidth * kHeight), marks_(samples_.size(), 0) {
    std::mt19937_64 generator(9);
    std::normal_distribution<double> normal(64.0, 1.3);
    for (auto& v : samples_) v = static_cast<std::uint16_t>(std::lround(normal(generator)));
  }
  static constexpr int kWidth = 120, kHeight = 80;
  std::vector<std::uint16_t> samples_;
  std::vector<std::uint8_t> marks_;
};

TEST_F(DarkPixels, MeanIsNotPulledByHotOnes) {
  for (std::size_t i = 0; i < samples_.size(); i += 97) samples_[i] = 3000;
  const DarkFrame f = dark_frame(samples_, marks_, kWidth, 1.0);
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_NEAR(f.mean_counts[p], 64.0, 5 * f.std_of_mean[p]);
    EXPECT_NEAR(f.std_of_mean[p], std::sqrt(1.69 + 1.0 / 12) / std::sqrt(2400.0), 0.003);
  }
}

TEST_F(DarkPixels, HotOnesAreFoundAndNoOthers) {
  std::vector<float> sums(samples_.size());
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = 3 * static_cast<float>(samples_[i]);
  sums[77] += 3 * 40;
  sums[5000] += 3 * 15;
  EXPECT_EQ(hot_pixels(sums, 3, kWidth, 1.3 * std::sqrt(3.0), 2.0),
            (std::vector<std::size_t>{77, 5000}));
}

TEST_F(DarkPixels, LightFromOneSideShows) {
  const Unevenness even = unevenness(samples_, marks_, kWidth);
  EXPECT_LT(even.counts, 5 * even.std);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    samples_[i] = static_cast<std::uint16_t>(samples_[i] + (i % kWidth) / 20);
  }
  const Unevenness leak = unevenness(samples_, marks_, kWidth);
  EXPECT_GT(leak.counts, 2.0);
  EXPECT_GT(leak.counts, 8 * leak.std);
}

}  // namespace
}  // namespace scattermeter::calib
