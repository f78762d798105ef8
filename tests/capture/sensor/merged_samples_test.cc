#include "capture/sensor/merged_samples.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

constexpr double kGain = 5.0;  // electrons per count
constexpr double kReadVariance = 1.7;
constexpr double kClip = 4000.0;

double variance_of(double counts) { return std::max(0.0, counts) / kGain + kReadVariance; }

// `rate` in counts per second at every sample, exposed without noise, or with it.
CfaSamples exposed(int width, int height, const std::vector<double>& rate, double exposure_s,
                   std::mt19937_64* noise = nullptr) {
  CfaSamples s;
  s.x0 = 4;
  s.y0 = 6;
  s.width = width;
  s.height = height;
  s.channel_of_phase = {0, 1, 1, 2};
  s.exposure_s = exposure_s;
  s.variance_per_count = 1.0 / kGain;
  for (const double r : rate) {
    double counts = r * exposure_s;
    if (noise != nullptr) {
      counts += std::sqrt(variance_of(counts)) * std::normal_distribution<double>()(*noise);
    }
    s.clipped.push_back(counts >= kClip ? kSampleClipped : std::uint8_t{0});
    s.signal_counts.push_back(s.clipped.back() != 0 ? 1e9F : static_cast<float>(counts));
    s.variance_counts2.push_back(static_cast<float>(variance_of(counts)));
  }
  return s;
}

std::vector<double> ramp(int n) {
  std::vector<double> rate;
  for (int i = 0; i < n; ++i) rate.push_back(100.0 + 40.0 * i);
  return rate;
}

// The textbook's weighted mean, written out for three exposures of which nothing is clipped.
TEST(MergedSamples, AreTheMeanByInverseVariance) {
  std::mt19937_64 noise(1);
  const std::vector<double> rate = ramp(60);
  const std::vector<double> times_s = {0.4, 0.05, 1.5};
  std::vector<CfaSamples> bracket;
  for (const double t : times_s) bracket.push_back(exposed(10, 6, rate, t, &noise));
  const CfaSamples merged = merged_samples(bracket);
  EXPECT_EQ(merged.exposure_s, 0.4);
  for (std::size_t i = 0; i < rate.size(); ++i) {
    double counts = 0, time_s = 0;
    for (const CfaSamples& s : bracket) {
      counts += static_cast<double>(s.signal_counts[i]);
      time_s += s.exposure_s;
    }
    double sum = 0, sum_w = 0, growth = 0;
    std::vector<double> weights;
    for (std::size_t k = 0; k < 3; ++k) {
      // Of counts per second.
      const double t = times_s[k];
      const double variance = variance_of(counts / time_s * t) / (t * t);
      weights.push_back(1.0 / variance);
      sum += static_cast<double>(bracket[k].signal_counts[i]) / t / variance;
      sum_w += 1.0 / variance;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      // A count more of the merged are t / 0.4 counts more here.
      const double t = times_s[k];
      const double part = weights[k] / sum_w;
      growth += part * part * (0.4 / t) * (0.4 / t) * (t / 0.4) / kGain;
      EXPECT_NEAR(merged.part_of_exposure[k][i], part, 2e-6);
    }
    EXPECT_NEAR(merged.signal_counts[i] / (0.4 * sum / sum_w), 1.0, 2e-6);
    EXPECT_NEAR(merged.variance_counts2[i] / (0.16 / sum_w), 1.0, 1e-5);
    EXPECT_NEAR(merged.variance_per_count_of[i] / growth, 1.0, 1e-5);
    EXPECT_EQ(merged.clipped[i], 0);
  }
}

TEST(MergedSamples, OneIsItself) {
  const CfaSamples one = exposed(10, 6, ramp(60), 0.3);
  const CfaSamples merged = merged_samples({one});
  EXPECT_EQ(merged.signal_counts, one.signal_counts);
  EXPECT_EQ(merged.variance_counts2, one.variance_counts2);
  EXPECT_TRUE(merged.part_of_exposure.empty());
}

// Left to right ever brighter: the long exposure clips from some column on, further right the short
// one, too.
TEST(MergedSamples, ClippedOnesAreLeftOut) {
  constexpr int kWidth = 60;
  std::vector<double> rate;
  for (int i = 0; i < kWidth * 8; ++i) rate.push_back(50.0 * (i % kWidth + 1));
  // The long one clips from column 19, the short one from column 49 on.
  const CfaSamples merged =
      merged_samples({exposed(kWidth, 8, rate, 4.0), exposed(kWidth, 8, rate, 1.6)});
  for (std::size_t i = 0; i < rate.size(); ++i) {
    const auto x = static_cast<int>(i % kWidth);
    const bool long_counts = x < 15 || (x < 16 && x % 2 == 0);
    // From 19 on clipped; 19 reaches 15, 17; 20 reaches 16, 18.
    EXPECT_EQ(merged.part_of_exposure[0][i] > 0.0F, long_counts) << x;
    EXPECT_EQ(merged.clipped[i], x < 49 ? 0 : kSampleClipped) << x;
    if (x >= 49) continue;
    EXPECT_NEAR(merged.signal_counts[i] / (4.0 * rate[i]), 1.0, 1e-6) << x;
    EXPECT_NEAR(merged.part_of_exposure[0][i] + merged.part_of_exposure[1][i], 1.0, 1e-6);
    if (long_counts) continue;
    EXPECT_NEAR(merged.variance_counts2[i] / (6.25 * variance_of(1.6 * rate[i])), 1.0, 1e-5);
  }
}

TEST(MergedSamples, DefectInOneIsADefect) {
  std::vector<CfaSamples> bracket = {exposed(10, 6, ramp(60), 0.4), exposed(10, 6, ramp(60), 0.1)};
  bracket[1].clipped[33] = kSampleDefect;
  bracket[1].signal_counts[33] = 1e9F;
  const CfaSamples merged = merged_samples(bracket);
  EXPECT_EQ(merged.clipped[33], kSampleDefect);
  EXPECT_EQ(merged.clipped[31], 0);
  EXPECT_GT(merged.part_of_exposure[1][31], 0.0F);
}

// A camera that cuts its noise off at zero: the short exposure has no say in the dark.
TEST(MergedSamples, CutOffDarkIsLeftToTheLong) {
  std::vector<CfaSamples> bracket = {exposed(10, 6, ramp(60), 0.1), exposed(10, 6, ramp(60), 1.0)};
  for (CfaSamples& s : bracket) s.floor_counts = 50.0;
  const CfaSamples merged = merged_samples(bracket);
  EXPECT_DOUBLE_EQ(merged.floor_counts, 5.0);
  EXPECT_EQ(merged.part_of_exposure[0][0], 0.0F);
  EXPECT_EQ(merged.part_of_exposure[1][0], 1.0F);
  EXPECT_GT(merged.part_of_exposure[0][59], 0.0F);
}

// Many merged samples of one brightness; parameter: how many of its deviations the long exposure
// lies below the clip level.
class NearTheClipLevel : public ::testing::TestWithParam<double> {};

TEST_P(NearTheClipLevel, TheMeanIsNotPulledDown) {
  const double std = std::sqrt(variance_of(kClip));
  const double long_counts = kClip - GetParam() * std;
  constexpr int kSide = 400;
  const std::vector<double> rate(kSide * kSide, long_counts);
  std::mt19937_64 noise(7);
  const std::vector<CfaSamples> bracket = {exposed(kSide, kSide, rate, 1.0, &noise),
                                           exposed(kSide, kSide, rate, 0.25, &noise)};
  const CfaSamples merged = merged_samples(bracket);
  double sum = 0, variance = 0, by_own_mark = 0;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    ASSERT_EQ(merged.clipped[i], 0);
    sum += static_cast<double>(merged.signal_counts[i]) - long_counts;
    variance += static_cast<double>(merged.variance_counts2[i]);
    const double short_one = 4.0 * static_cast<double>(bracket[1].signal_counts[i]);
    const bool clipped = bracket[0].clipped[i] != 0;
    by_own_mark +=
        (clipped ? short_one
                 : 0.8 * static_cast<double>(bracket[0].signal_counts[i]) + 0.2 * short_one) -
        long_counts;
  }
  const auto n = static_cast<double>(rate.size());
  // Four deviations of the mean, and what the header owns up to.
  EXPECT_LT(std::abs(sum / n), 0.04 * std + 4.0 * std::sqrt(variance) / n);
  // It would be, by each sample's own mark.
  if (GetParam() < 1.5) {
    EXPECT_LT(by_own_mark / n, -0.09 * std);
  }
}

INSTANTIATE_TEST_SUITE_P(Distances, NearTheClipLevel, ::testing::Values(0.0, 1.0, 1.8, 2.5, 4.0));

// With weights of each sample's own noise the mean of 30 counts would be low by an electron of
// each, 2 %. Without light all exposures have a say, whatever the sign of the noise.
class DimLight : public ::testing::TestWithParam<double> {};

TEST_P(DimLight, IsNotBiased) {
  const std::vector<double> rate(300 * 300, GetParam());
  std::mt19937_64 noise(3);
  const CfaSamples merged =
      merged_samples({exposed(300, 300, rate, 1.0, &noise), exposed(300, 300, rate, 0.5, &noise),
                      exposed(300, 300, rate, 2.0, &noise)});
  double sum = 0, squares = 0, variance = 0;
  for (std::size_t i = 0; i < rate.size(); ++i) {
    const double d = static_cast<double>(merged.signal_counts[i]) - GetParam();
    for (const std::vector<float>& part : merged.part_of_exposure) ASSERT_GT(part[i], 0.0F);
    sum += d;
    squares += d * d;
    variance += static_cast<double>(merged.variance_counts2[i]);
  }
  const auto n = static_cast<double>(rate.size());
  EXPECT_LT(std::abs(sum / n), 4.0 * std::sqrt(variance) / n);
  // In the dark the noise model takes noise above zero for photons.
  if (GetParam() == 0.0) return;
  // chi-square of n: its relative deviation is sqrt(2 / n).
  EXPECT_NEAR(squares / variance, 1.0, 4.0 * std::sqrt(2.0 / n));
}

INSTANTIATE_TEST_SUITE_P(Rates, DimLight, ::testing::Values(0.0, 30.0));

TEST(MergedSamples, RefusesWhatDoesNotBelongTogether) {
  EXPECT_THROW(merged_samples({}), std::invalid_argument);
  const CfaSamples one = exposed(10, 6, ramp(60), 0.4);
  CfaSamples other = one;
  other.x0 += 2;
  EXPECT_THROW(merged_samples({one, other}), std::invalid_argument);
  other = one;
  other.channel_of_phase = {1, 0, 2, 1};
  EXPECT_THROW(merged_samples({one, other}), std::invalid_argument);
  other = one;
  other.exposure_s = 0.0;
  EXPECT_THROW(merged_samples({one, other}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
