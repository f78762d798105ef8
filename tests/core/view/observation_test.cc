#include "core/view/observation.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// A map of two rows, left and right half of an 8 x 4 rectangle, with factor 2 for every sample.
SampleMap two_rows() {
  SampleMap map;
  map.x0 = 10;
  map.y0 = 20;
  map.width = 8;
  map.height = 4;
  for (int i = 0; i < 32; ++i) map.row_of_sample.push_back(i % 8 < 4 ? 0 : 1);
  map.pi_over_transmittance.assign(32, 2.0F);
  map.patch_of_row = {5, 6};
  return map;
}

CfaSamples samples() {
  CfaSamples s;
  s.x0 = 10;
  s.y0 = 20;
  s.width = 8;
  s.height = 4;
  s.channel_of_phase = {0, 1, 1, 2};
  s.exposure_s = 0.5;
  s.signal_counts.assign(32, 100.0F);
  s.variance_counts2.assign(32, 9.0F);
  s.clipped.assign(32, 0);
  return s;
}

TEST(Observation, MeansVariancesAndUnits) {
  const Observation o = observe(samples(), two_rows(), {10.0, 20.0, 40.0});
  // l = factor * counts / (responsivity * exposure); 4 red, 8 green, 4 blue samples in each row.
  EXPECT_NEAR(o.channel[0].l[0], 2.0 * 100.0 / (10.0 * 0.5), 1e-9);
  EXPECT_NEAR(o.channel[1].l[1], 2.0 * 100.0 / (20.0 * 0.5), 1e-9);
  EXPECT_NEAR(o.channel[0].variance[0], 4.0 * 9.0 / 4.0 / 25.0, 1e-9);
  EXPECT_NEAR(o.channel[1].variance[0], 4.0 * 9.0 / 8.0 / 100.0, 1e-9);
  EXPECT_EQ(o.channel[2].rows_used, 2U);
  EXPECT_EQ(o.channel[1].samples, 16U);
}

// One clipped sample, whatever it holds, takes its patch out of its channel and of no other.
TEST(Observation, ClippedSampleTakesItsRowOut) {
  CfaSamples s = samples();
  s.clipped[0] = 1;  // red, row 0
  s.signal_counts[0] = std::nanf("");
  const Observation o = observe(s, two_rows(), {10.0, 20.0, 40.0});
  EXPECT_EQ(o.channel[0].state[0], RowState::kClipped);
  EXPECT_EQ(o.channel[0].state[1], RowState::kUsed);
  EXPECT_EQ(o.channel[1].state[0], RowState::kUsed);
  EXPECT_EQ(o.channel[0].rows_clipped, 1U);
  EXPECT_EQ(o.channel[0].samples_clipped, 1U);
  EXPECT_TRUE(std::isfinite(o.channel[0].l[1]));
}

TEST(Observation, SamplesOutsideRowsHaveNoSay) {
  SampleMap map = two_rows();
  CfaSamples s = samples();
  for (std::size_t i = 0; i < 32; i += 5) {
    map.row_of_sample[i] = -1;
    s.signal_counts[i] = 1e9F;
  }
  const Observation o = observe(s, map, {10.0, 20.0, 40.0});
  for (const ChannelObservation& c : o.channel) {
    for (std::size_t r = 0; r < 2; ++r) {
      EXPECT_LT(c.l[r], 100.0);
    }
  }
}

TEST(Observation, FloorTakesDarkRowsOut) {
  CfaSamples s = samples();
  s.floor_counts = 101.0;
  const Observation o = observe(s, two_rows(), {10.0, 20.0, 40.0});
  EXPECT_EQ(o.channel[0].rows_floor, 2U);
  EXPECT_EQ(o.channel[0].rows_used, 0U);
}

// Samples that scatter as their variances say have no excess; where they scatter twice as much, so
// do the rows.
TEST(Observation, NoiseThatExceedsItsModel) {
  SampleMap map;
  map.width = 200;
  map.height = 100;
  map.row_of_sample.assign(20'000, 0);
  map.pi_over_transmittance.assign(20'000, 3.0F);
  map.patch_of_row = {0};
  CfaSamples s = samples();
  s.x0 = s.y0 = 0;
  s.width = 200;
  s.height = 100;
  s.variance_counts2.assign(20'000, 16.0F);
  s.clipped.assign(20'000, 0);
  std::mt19937 random(3);
  std::normal_distribution<float> normal(500.0F, 4.0F);
  s.signal_counts.resize(20'000);
  for (float& v : s.signal_counts) v = normal(random);
  const Observation as_stated = observe(s, map, {1.0, 1.0, 1.0});
  s.variance_counts2.assign(20'000, 4.0F);
  const Observation understated = observe(s, map, {1.0, 1.0, 1.0});
  for (std::size_t c = 0; c < kRgb; ++c) {
    const ChannelObservation& right = as_stated.channel[c];
    const ChannelObservation& wrong = understated.channel[c];
    EXPECT_EQ(right.noise_excess, 1.0);
    // 5000 differences and more: 2.8 % deviation for red; four of that.
    EXPECT_NEAR(wrong.noise_excess, 4.0, 0.5);
    EXPECT_NEAR(wrong.variance[0] / right.variance[0], wrong.noise_excess / 4.0, 1e-9);
    EXPECT_NEAR(wrong.brightest_snr / right.brightest_snr, 2.0, 1e-9);  // as stated
  }
}

// The variance grows with l as it does where every sample is brighter: two shots of one scene, the
// second with twice the light, whose samples' variances are read noise and photons. Samples of
// uneven factors, and colours whose places in the patch differ.
TEST(Observation, VariancePerL) {
  SampleMap map = two_rows();
  for (std::size_t i = 0; i < 32; ++i) {
    map.pi_over_transmittance[i] = 2.0F + 0.1F * static_cast<float>(i % 3);
    if (i % 11 == 0) map.row_of_sample[i] = -1;
  }
  CfaSamples dim = samples();
  dim.variance_per_count = 0.25;
  CfaSamples bright = dim;
  for (std::size_t i = 0; i < 32; ++i) {
    // Even radiance: counts fall as the factor rises.
    const float counts = 200.0F / map.pi_over_transmittance[i];
    dim.signal_counts[i] = counts;
    bright.signal_counts[i] = 2.0F * counts;
    dim.variance_counts2[i] = 9.0F + 0.25F * counts;
    bright.variance_counts2[i] = 9.0F + 0.25F * 2.0F * counts;
  }
  const Observation one = observe(dim, map, {10.0, 20.0, 40.0});
  const Observation two = observe(bright, map, {10.0, 20.0, 40.0});
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t r = 0; r < 2; ++r) {
      const ChannelObservation& a = one.channel[c];
      const ChannelObservation& b = two.channel[c];
      const double slope = (b.variance[r] - a.variance[r]) / (b.l[r] - a.l[r]);
      EXPECT_GT(slope, 0.0);
      EXPECT_NEAR(a.variance_per_l[r] / slope, 1.0, 1e-5) << "channel " << c << ", row " << r;
    }
  }
  // One phase of factor 2 over 4 samples: unit * variance_per_count * factor / n.
  CfaSamples plain = samples();
  plain.variance_per_count = 0.25;
  EXPECT_NEAR(observe(plain, two_rows(), {10.0, 20.0, 40.0}).channel[0].variance_per_l[0],
              0.25 * 2.0 / 4.0 / (10.0 * 0.5), 1e-9);
}

// Of a bracket: which part of a row comes from which exposure, a defect sample left out of it; and
// photon noise of each sample by itself.
TEST(Observation, PartsOfExposures) {
  CfaSamples s = samples();
  s.part_of_exposure = {std::vector<float>(32, 1.0F), std::vector<float>(32, 0.0F)};
  // Red of the left half: samples 0, 2, 16, 18.
  s.part_of_exposure[0][0] = 0.25F;
  s.part_of_exposure[1][0] = 0.75F;
  s.part_of_exposure[0][16] = 0.0F;
  s.part_of_exposure[1][16] = 1.0F;
  s.clipped[18] = kSampleDefect;
  s.part_of_exposure[0][18] = 1e9F;
  s.variance_per_count_of.assign(32, 0.25F);
  s.variance_per_count_of[0] = 0.5F;
  SampleMap map = two_rows();
  map.pi_over_transmittance[2] = 3.0F;
  const Observation o = observe(s, map, {10.0, 20.0, 40.0});
  const ChannelObservation& red = o.channel[0];
  ASSERT_EQ(red.exposures.size(), 2U);
  EXPECT_NEAR(red.exposures[0].of_row[0], (2.0 * 0.25 + 3.0 + 0.0) / 7.0, 1e-6);
  EXPECT_NEAR(red.exposures[1].of_row[0], (2.0 * 0.75 + 0.0 + 2.0) / 7.0, 1e-6);
  EXPECT_EQ(red.exposures[0].samples, 6U);  // two of the left, four of the right
  EXPECT_EQ(red.exposures[1].samples, 2U);
  EXPECT_DOUBLE_EQ(red.exposures[0].of_row[1], 1.0);
  EXPECT_DOUBLE_EQ(o.channel[2].exposures[1].of_row[0], 0.0);
  // Four samples of factor 2 in the right half of red.
  EXPECT_NEAR(red.variance_per_l[1], 0.25 * 2.0 / 4.0 / (10.0 * 0.5), 1e-9);
  CfaSamples even = s;
  even.variance_per_count_of.assign(32, 0.25F);
  const double more =
      red.variance_per_l[0] / observe(even, map, {10.0, 20.0, 40.0}).channel[0].variance_per_l[0];
  EXPECT_NEAR(more, (2.0 * 0.5 + 3.0 * 0.25 + 2.0 * 0.25) / (7.0 * 0.25), 1e-6);
}

TEST(Observation, RefusesWhatDoesNotMatch) {
  CfaSamples s = samples();
  s.x0 = 11;
  EXPECT_THROW(observe(s, two_rows(), {1, 1, 1}), std::invalid_argument);
  s = samples();
  s.exposure_s = 0.0;
  EXPECT_THROW(observe(s, two_rows(), {1, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
