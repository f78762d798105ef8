#include "capture/sensor/ideal_samples.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "capture/raw/decoded_frame.h"
#include "capture/raw/tone_curve.h"
#include "capture/sensor/linear_samples.h"

namespace scattermeter::capture {
namespace {

// A ramp of 12 x 10 samples that ends beyond the converter's top.
std::vector<float> ramp() {
  std::vector<float> signal(120);
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] = 34.37F * static_cast<float>(i + 1);
  return signal;
}

void expect_rounds_to_the_raw(const SensorModel& sensor, double largest_step_counts) {
  RawMetadata metadata;
  metadata.black_counts = sensor.black_counts;
  metadata.white_counts = sensor.white_counts;
  metadata.linearization_table = sensor.tone_curve;
  SensorModel quiet = sensor;
  quiet.noise_on = false;
  const CfaSamples raw =
      linear_samples(decoded_frame(12, 10, expose(ramp(), 12, 10, quiet, 1), metadata),
                     sensor.noise, 0.1, 0, 0, 12, 10);
  const CfaSamples ideal = ideal_samples(ramp(), 0, 0, 12, 10, sensor, metadata.cfa, 0.1);
  EXPECT_EQ(ideal.signal_counts, ramp());
  EXPECT_EQ(ideal.channel_of_phase, raw.channel_of_phase);
  EXPECT_EQ(ideal.exposure_s, raw.exposure_s);
  EXPECT_EQ(ideal.floor_counts, 0.0);
  EXPECT_EQ(ideal.clipped, raw.clipped);
  EXPECT_EQ(ideal.clipped.front(), 0);
  EXPECT_EQ(ideal.clipped.back(), 1);
  for (std::size_t i = 0; i < 120; ++i) {
    if (ideal.clipped[i] != 0) continue;
    EXPECT_NEAR(ideal.signal_counts[i], raw.signal_counts[i], 0.5 * largest_step_counts + 1e-3);
    // Photon noise at the signal and at the code next to it differ by no more than their distance;
    // the step of the curve changes by one from code to code.
    EXPECT_NEAR(ideal.variance_counts2[i], raw.variance_counts2[i],
                0.5 * largest_step_counts / sensor.noise.gain_e_per_count +
                    largest_step_counts * largest_step_counts / 12.0);
  }
}

TEST(IdealSamples, AreTheRawsBeforeRounding) {
  SensorModel sensor;
  sensor.noise = {6.0, 1.2};
  sensor.black_counts = {64, 65, 66, 67};
  expect_rounds_to_the_raw(sensor, 1.0);
}

TEST(IdealSamples, EndWhereTheToneCurveEnds) {
  SensorModel sensor;
  sensor.tone_curve = nef_lossy_curve();
  double step = 0.0;
  for (std::size_t i = 1; i < sensor.tone_curve.size(); ++i) {
    step = std::max<double>(step, sensor.tone_curve[i] - sensor.tone_curve[i - 1]);
  }
  expect_rounds_to_the_raw(sensor, step);
}

// The rectangle starts at an odd place: phases go by the frame.
TEST(IdealSamples, PhasesGoByTheFrame) {
  SensorModel sensor;
  sensor.black_counts = {0, 10, 20, 4000};
  const CfaSamples s =
      ideal_samples(std::vector<float>(4, 100.0F), 1, 1, 2, 2, sensor, CfaPattern{}, 0.1);
  EXPECT_EQ(s.x0, 1);
  // (1, 1) is phase 3, whose black leaves no room for 100 counts.
  EXPECT_EQ(s.clipped, (std::vector<std::uint8_t>{1, 0, 0, 0}));
  EXPECT_NEAR(s.variance_counts2[1], 100.0 / 6.0 + 1.0 + 1.0 / 12.0, 1e-4);
}

TEST(IdealSamples, RefusesWhatDoesNotFit) {
  EXPECT_THROW(ideal_samples({1.0F}, 0, 0, 2, 2, {}, {}, 0.1), std::invalid_argument);
  EXPECT_THROW(ideal_samples({1.0F}, -1, 0, 1, 1, {}, {}, 0.1), std::invalid_argument);
  EXPECT_THROW(ideal_samples({1.0F}, 0, 0, 1, 1, {}, {}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
