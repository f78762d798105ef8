#include "capture/sensor/noise_curve.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

// A ramp of light whose noise is `factor` times the variance that it states, on one row of a map
// per band of 20 lines; one band is clipped and holds absurd values.
struct Ramp {
  CfaSamples samples;
  SampleMap map;
  explicit Ramp(double factor) {
    constexpr int kWidth = 400;
    constexpr int kHeight = 200;
    samples.width = map.width = kWidth;
    samples.height = map.height = kHeight;
    samples.channel_of_phase = {0, 1, 1, 2};
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double mean = 50.0 + 1900.0 * y / kHeight + 0.5 * x;
        const double variance = 1.5 + mean / 6.0;
        const bool clipped = y < 20;
        samples.signal_counts.push_back(static_cast<float>(
            clipped ? 1e6 * normal(random) : mean + std::sqrt(factor * variance) * normal(random)));
        samples.variance_counts2.push_back(static_cast<float>(variance));
        samples.clipped.push_back(clipped ? 1 : 0);
        map.row_of_sample.push_back(y / 20);
      }
    }
  }
};

TEST(NoiseCurve, MeetsTheVarianceWithinItsDeviation) {
  for (const double factor : {1.0, 1.5}) {
    const Ramp ramp(factor);
    for (const auto& channel : noise_curve(ramp.samples, ramp.map)) {
      ASSERT_GE(channel.size(), 4U);
      for (const NoisePoint& p : channel) {
        if (p.triples < 50) continue;  // too few for a normal error
        EXPECT_NEAR(p.variance_counts2 / p.model_counts2, factor,
                    4.5 * p.relative_std * p.variance_counts2 / p.model_counts2)
            << p.mean_counts;
        EXPECT_NEAR(p.model_counts2, 1.5 + p.mean_counts / 6.0, 0.05 * p.model_counts2);
        EXPECT_LT(p.mean_counts, 2500.0);
      }
    }
  }
}

TEST(NoiseCurve, RefusesAnotherRectangle) {
  Ramp ramp(1.0);
  ramp.map.x0 = 2;
  EXPECT_THROW(noise_curve(ramp.samples, ramp.map), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
