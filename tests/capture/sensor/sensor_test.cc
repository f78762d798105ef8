#include "capture/sensor/sensor.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "capture/raw/tone_curve.h"

namespace scattermeter::capture {
namespace {

using testing::ElementsAre;

struct Moments {
  double mean;
  double variance;
};

Moments moments_of(const std::vector<std::uint16_t>& codes) {
  double sum = 0;
  double sum2 = 0;
  for (const std::uint16_t code : codes) {
    sum += code;
    sum2 += static_cast<double>(code) * code;
  }
  const auto n = static_cast<double>(codes.size());
  return {sum / n, (sum2 - sum * sum / n) / (n - 1)};
}

TEST(Expose, WithoutNoiseAddsBlackRoundsAndClips) {
  SensorModel sensor;
  sensor.noise_on = false;
  sensor.black_counts = {10, 20, 30, 40};
  EXPECT_THAT(expose({0.0F, 1.4F, 1.6F, 5000.0F, 7.5F, 0.2F, 4055.0F, 4056.0F}, 4, 2, sensor, 1),
              ElementsAre(10, 21, 12, 4095, 38, 40, 4085, 4095));
}

TEST(Expose, StoresTheNearestCodeOfTheCurve) {
  SensorModel sensor;
  sensor.noise_on = false;
  sensor.black_counts = {0, 0, 0, 0};
  sensor.tone_curve = nef_lossy_curve();
  const std::vector<float> signal = {0.0F, 20.0F, 1000.0F, 4095.0F};
  const std::vector<std::uint16_t> codes = expose(signal, 4, 1, sensor, 1);
  for (std::size_t i = 0; i < signal.size(); ++i) {
    EXPECT_EQ(codes[i], nearest_code(sensor.tone_curve, static_cast<double>(signal[i])));
  }
  EXPECT_EQ(codes[3], 682);
}

TEST(Expose, IsTheSameForAnyNumberOfThreads) {
  std::vector<float> signal(640 * 200);
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] = static_cast<float>(i % 3000);
  const SensorModel sensor;
  std::vector<std::vector<std::uint16_t>> frames;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            threads);
    frames.push_back(expose(signal, 640, 200, sensor, 42));
  }
  EXPECT_EQ(frames[0], frames[1]);
  EXPECT_EQ(frames[0], frames[2]);
  EXPECT_NE(frames[0], expose(signal, 640, 200, sensor, 43));
  EXPECT_NE(frames[0], expose(signal, 640, 200, sensor, 42 + (std::uint64_t{1} << 32U)));
}

// Photon transfer (Janesick): variance against mean is a line whose slope is 1 / gain and whose
// offset is the read noise. Each of n samples' variance has the relative standard deviation
// sqrt(2 / n), so the mean slope of the levels is known to sqrt(2 / n / levels); five of those.
TEST(Expose, PhotonTransferGivesTheInjectedGain) {
  constexpr std::size_t kSamples = 200000;
  for (const double gain : {1.5, 6.0, 40.0}) {
    SensorModel sensor;
    sensor.noise = {gain, 2.0};
    double slopes = 0;
    const std::vector<float> levels = {60.0F, 300.0F, 1000.0F, 2000.0F, 3000.0F};
    for (const float level : levels) {
      const Moments m =
          moments_of(expose(std::vector<float>(kSamples, level), 500, 400, sensor, 5));
      slopes += (m.variance - 4.0 - 1.0 / 12) / (m.mean - 64) / static_cast<double>(levels.size());
      EXPECT_NEAR(m.mean, 64 + level, 5 * std::sqrt(m.variance / kSamples)) << gain;
    }
    // The offset's own scatter, relative to the slope, is largest at the darkest level.
    const double offset_error = 1 + gain * 4.0 / 60;
    EXPECT_NEAR(slopes * gain, 1.0, 5 * offset_error * std::sqrt(2.0 / kSamples / 5)) << gain;
  }
}

// Few electrons are Poisson, not rounded normal: with gain 1 and no read noise the share of zeros
// is exp(-mean). Binomial standard deviation, five of them.
TEST(Expose, FewElectronsArePoisson) {
  SensorModel sensor;
  sensor.noise = {1.0, 0.0};
  for (const float mean : {0.05F, 0.7F, 3.0F}) {
    const std::vector<std::uint16_t> codes =
        expose(std::vector<float>(100000, mean), 1000, 100, sensor, 3);
    const double p = std::exp(-static_cast<double>(mean));
    const auto zeros = static_cast<double>(std::count(codes.begin(), codes.end(), 64));
    EXPECT_NEAR(zeros / 1e5, p, 5 * std::sqrt(p * (1 - p) / 1e5)) << mean;
  }
}

TEST(Expose, RowsAreUnrelated) {
  constexpr int kWidth = 20000;
  const std::vector<std::uint16_t> codes =
      expose(std::vector<float>(2 * kWidth, 1000.0F), kWidth, 2, SensorModel{}, 0);
  const auto second = codes.begin() + kWidth;
  const Moments a = moments_of({codes.begin(), second});
  const Moments b = moments_of({second, codes.end()});
  double covariance = 0;
  for (std::size_t x = 0; x < kWidth; ++x) {
    covariance += (codes[x] - a.mean) * (codes[kWidth + x] - b.mean) / kWidth;
  }
  EXPECT_NEAR(covariance / std::sqrt(a.variance * b.variance), 0, 5 / std::sqrt(kWidth));
}

TEST(Expose, RefusesBrokenPreconditions) {
  const SensorModel sensor;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_THROW(expose({1.0F}, 2, 1, sensor, 0), std::invalid_argument);
  EXPECT_THROW(expose({}, 0, 0, sensor, 0), std::invalid_argument);
  for (const float bad : {nan, infinity, -1.0F}) {
    EXPECT_THROW(expose({1.0F, bad}, 2, 1, sensor, 0), std::invalid_argument) << bad;
  }
  SensorModel bad = sensor;
  bad.noise.gain_e_per_count = 0;
  EXPECT_THROW(expose({1.0F}, 1, 1, bad, 0), std::invalid_argument);
  bad = sensor;
  bad.noise.read_noise_counts = -1;
  EXPECT_THROW(expose({1.0F}, 1, 1, bad, 0), std::invalid_argument);
  bad = sensor;
  bad.white_counts = 70000;
  EXPECT_THROW(expose({1.0F}, 1, 1, bad, 0), std::invalid_argument);
  bad = sensor;
  bad.tone_curve = {5, 3};
  EXPECT_THROW(expose({1.0F}, 1, 1, bad, 0), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
