#include "capture/sensor/linear_samples.h"

#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

RawFrame frame() {
  RawFrame f;
  f.width_px = 6;
  f.height_px = 4;
  f.samples.assign(24, 500);
  f.black_counts = {64, 65, 66, 67};
  f.white_counts = 4095;
  return f;
}

TEST(LinearSamples, SubtractsEachPhasesBlack) {
  const CfaSamples s = linear_samples(frame(), {6.0, 1.2}, 0.1, 1, 1, 3, 2);
  EXPECT_EQ(s.width, 3);
  EXPECT_EQ(s.x0, 1);
  // (1, 1) is phase 3, (2, 1) phase 2, (1, 2) phase 1.
  EXPECT_EQ(s.signal_counts[0], 500.0F - 67.0F);
  EXPECT_EQ(s.signal_counts[1], 500.0F - 66.0F);
  EXPECT_EQ(s.signal_counts[3], 500.0F - 65.0F);
  EXPECT_EQ(s.channel(1, 1), 2);
  EXPECT_EQ(s.channel(2, 1), 1);
  // Photons over gain, read noise, rounding.
  EXPECT_NEAR(s.variance_counts2[0], 433.0 / 6.0 + 1.44 + 1.0 / 12.0, 1e-3);
  EXPECT_EQ(s.floor_counts, 0.0);
}

TEST(LinearSamples, MarksClippedSamples) {
  RawFrame f = frame();
  f.samples[7] = 4095;  // (1, 1)
  f.samples[8] = 4094;
  const CfaSamples s = linear_samples(f, {6.0, 1.2}, 0.1, 0, 0, 6, 4);
  EXPECT_EQ(s.clipped[7], 1);
  EXPECT_EQ(s.clipped[8], 0);
}

// The slope is the one that the samples' own variances have.
TEST(LinearSamples, PhotonNoisePerCount) {
  RawFrame f = frame();
  f.samples[0] = 1500;
  const CfaSamples s = linear_samples(f, {6.0, 1.2}, 0.1, 0, 0, 6, 4);
  EXPECT_DOUBLE_EQ(s.variance_per_count, 1.0 / 6.0);
  EXPECT_NEAR(
      (s.variance_counts2[0] - s.variance_counts2[2]) / (s.signal_counts[0] - s.signal_counts[2]),
      s.variance_per_count, 1e-5);
}

// Black at zero: the camera cuts the noise, and means below four deviations are biased.
TEST(LinearSamples, KnowsTheFloorOfACameraThatSubtractsBlack) {
  RawFrame f = frame();
  f.black_counts = {0, 0, 0, 3};
  EXPECT_DOUBLE_EQ(linear_samples(f, {6.0, 1.2}, 0.1, 0, 0, 6, 4).floor_counts, 4.8);
}

TEST(LinearSamples, RefusesWhatLeavesTheFrame) {
  EXPECT_THROW(linear_samples(frame(), {}, 0.1, 4, 0, 3, 2), std::invalid_argument);
  EXPECT_THROW(linear_samples(frame(), {}, 0.1, -1, 0, 3, 2), std::invalid_argument);
  EXPECT_THROW(linear_samples(frame(), {}, 0.0, 0, 0, 3, 2), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
