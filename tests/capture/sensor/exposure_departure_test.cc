#include "capture/sensor/exposure_departure.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "capture/sensor/merged_samples.h"

namespace scattermeter::capture {
namespace {

// An even field of 200 counts a second, shot for stated_s while the shutter was open for true_s.
CfaSamples shot(double stated_s, double true_s, std::uint64_t seed) {
  CfaSamples s;
  s.width = 60;
  s.height = 40;
  s.channel_of_phase = {0, 1, 1, 2};
  s.exposure_s = stated_s;
  s.variance_per_count = 0.2;
  std::mt19937_64 random(seed);
  for (int i = 0; i < s.width * s.height; ++i) {
    const double counts = 200.0 * true_s;
    const double variance = 0.2 * counts + 1.0;
    s.signal_counts.push_back(static_cast<float>(
        counts + std::sqrt(variance) * std::normal_distribution<double>()(random)));
    s.variance_counts2.push_back(static_cast<float>(variance));
    s.clipped.push_back(0);
  }
  return s;
}

TEST(ExposureDeparture, FindsTheTimeThatIsOff) {
  const std::vector<CfaSamples> bracket = {shot(1.0, 1.0, 1), shot(0.25, 0.25 * 1.05, 2)};
  const std::vector<ExposureDeparture> d = exposure_departures(bracket, merged_samples(bracket));
  ASSERT_EQ(d.size(), 2U);
  EXPECT_NEAR(d[1].log_ratio, std::log(1.05), 4.0 * d[1].noise_std);
  EXPECT_NEAR(d[0].log_ratio, -std::log(1.05), 4.0 * d[0].noise_std);
  // Both deviations by hand: sqrt(v / n) / mean.
  const double expected =
      std::sqrt(41.0 / 2400.0 / (200.0 * 200.0) + (0.2 * 52.5 + 1.0) / 2400.0 / (52.5 * 52.5));
  EXPECT_NEAR(d[1].noise_std / expected, 1.0, 0.01);
  EXPECT_NEAR(d[1].mean_counts, 52.5, 0.5);
}

// Where nothing is in both, nothing can be said; what is clipped takes no part.
TEST(ExposureDeparture, NeedsSamplesInCommon) {
  std::vector<CfaSamples> bracket = {shot(1.0, 1.0, 1), shot(0.25, 0.25, 2)};
  for (std::size_t i = 0; i < bracket[0].clipped.size(); ++i) {
    bracket[0].clipped[i] = kSampleClipped;
    bracket[0].signal_counts[i] = 1e9F;
  }
  for (const ExposureDeparture& d : exposure_departures(bracket, merged_samples(bracket))) {
    EXPECT_TRUE(std::isnan(d.log_ratio));
  }
  EXPECT_THROW(exposure_departures(bracket, bracket[0]), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
