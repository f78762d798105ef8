#include "capture/sensor/noise_model.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "capture/raw/tone_curve.h"
#include "capture/sensor/sensor.h"

namespace scattermeter::capture {
namespace {

TEST(NoiseModel, SumsPhotonReadAndQuantisationVariance) {
  RawFrame frame;
  frame.black_counts = {64, 64, 70, 64};
  const NoiseModel model({5.0, 2.0}, frame);
  EXPECT_NEAR(model.variance_counts2(1064, 0), 1000.0 / 5 + 4 + 1.0 / 12, 1e-4);
  EXPECT_NEAR(model.variance_counts2(1064, 2), 994.0 / 5 + 4 + 1.0 / 12, 1e-4);
  EXPECT_NEAR(model.variance_counts2(3, 0), 4 + 1.0 / 12, 1e-6);  // below black: no photons
  EXPECT_NEAR(model.variance_counts2(65535, 0), 65471.0 / 5 + 4 + 1.0 / 12, 1e-2);
}

TEST(NoiseModel, StepIsTheMeanDistanceToTheNeighbouringLevels) {
  RawFrame frame;
  frame.curve_levels = {0, 1, 3, 9, 21};
  frame.black_counts = {100, 100, 100, 100};
  const NoiseModel model({1.0, 0.0}, frame);
  const auto step = [&](std::uint16_t value) {
    return std::sqrt(12 * static_cast<double>(model.variance_counts2(value, 1)));
  };
  EXPECT_NEAR(step(0), 1, 1e-6);
  EXPECT_NEAR(step(1), 1.5, 1e-6);
  EXPECT_NEAR(step(3), 4, 1e-6);
  EXPECT_NEAR(step(9), 9, 1e-6);
  EXPECT_NEAR(step(21), 12, 1e-6);
  EXPECT_NEAR(step(5), 6, 1e-6);    // between two levels: their distance
  EXPECT_NEAR(step(50), 12, 1e-6);  // beyond the last: the last distance
}

TEST(NoiseModel, RefusesWhatIsNoSensor) {
  const RawFrame frame;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(NoiseModel({0.0, 1.0}, frame), std::invalid_argument);
  EXPECT_THROW(NoiseModel({-1.0, 1.0}, frame), std::invalid_argument);
  EXPECT_THROW(NoiseModel({nan, 1.0}, frame), std::invalid_argument);
  EXPECT_THROW(NoiseModel({1.0, -0.1}, frame), std::invalid_argument);
  EXPECT_THROW(NoiseModel({1.0, nan}, frame), std::invalid_argument);
}

// The spread of simulated samples around the truth is the one predicted, curve and all. n normal
// samples give a variance with the relative standard deviation sqrt(2 / n) = 0.45 %; five of those.
// The curve's integer steps change by one across the spread, s against s + 1, which the single step
// at the mean cannot know: (2 s + 1) / 12 counts^2.
TEST(NoiseModel, PredictsTheSpreadOfSimulatedFrames) {
  for (const bool curved : {false, true}) {
    RawFrame frame;
    frame.black_counts = {64, 64, 64, 64};
    SensorModel sensor;
    if (curved) sensor.tone_curve = frame.curve_levels = nef_lossy_curve();
    const NoiseModel model(sensor.noise, frame);
    for (const float signal : {0.0F, 10.0F, 100.0F, 700.0F, 2500.0F}) {
      const std::vector<float> signals(100000, signal);
      double sum2 = 0;
      for (const std::uint16_t code : expose(signals, 1000, 100, sensor, 7)) {
        const double value = curved ? sensor.tone_curve[code] : code;
        sum2 += (value - 64 - signal) * (value - 64 - signal);
      }
      const double sampled = sum2 / static_cast<double>(signals.size());
      const auto mean = static_cast<std::uint16_t>(std::lround(64 + signal));
      const double predicted = model.variance_counts2(mean, 0);
      double step_change = 0;
      if (curved) {
        const std::uint16_t code = nearest_code(frame.curve_levels, mean);
        step_change = (2.0 * (frame.curve_levels[code + 1U] - frame.curve_levels[code]) + 1) / 12;
      }
      EXPECT_NEAR(sampled, predicted, 5 * std::sqrt(2.0 / 100000) * predicted + step_change)
          << signal << (curved ? " through the curve" : "");
    }
  }
}

}  // namespace
}  // namespace scattermeter::capture
