#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/radiance/radiance_steps.h"
#include "tests/fixtures/calib/radiance_bench.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

// Light that falls off to the left by a third, so that a frame spans many levels.
double slanted(int x, int /*y*/) { return 15'000.0 + 80.0 * x; }

class RadianceFlatsTest : public ::testing::Test {
 protected:
  RadianceFlatsTest() {
    bench_.know_dark();
    bench_.calibration.correction.noise = {};
    for (const double t : {0.005, 0.01, 0.02, 0.04, 0.08, 0.16}) {
      for (int i = 0; i < 2; ++i) {
        bench_.input.shots.flats.push_back(bench_.shot("flat", t, slanted));
        bench_.input.shots.dark.push_back(bench_.shot("dark", t, no_light));
      }
    }
  }
  RadianceBench bench_;
};

TEST_F(RadianceFlatsTest, FindsGainNoiseAndALinearResponse) {
  find_response_and_noise(bench_.steps);
  const capture::RadianceCalibration& k = bench_.calibration;
  for (std::size_t c = 0; c < kRgb; ++c) {
    EXPECT_NEAR(k.correction.noise[c].gain_e_per_count, 6.0, 4.5 * k.gain_std_e_per_count[c]);
    EXPECT_LT(k.gain_std_e_per_count[c], 0.2);
    EXPECT_NEAR(k.correction.noise[c].read_noise_counts, 1.2, 4.5 * k.read_noise_std_counts[c]);
    EXPECT_LT(k.read_noise_std_counts[c], 0.1);
    EXPECT_NEAR(k.correction.response[c].log_ratio_at(2000.0), 0.0,
                4.5 * std::max(1e-3, std::sqrt(k.response_covariance[c].back())));
    EXPECT_GT(k.noise[c].size(), 3U);
  }
  EXPECT_GT(k.linearity.size(), 3U);
  EXPECT_TRUE(k.notes.empty());
  for (const capture::RadianceResidual& r : k.residuals) EXPECT_LT(r.rms, r.limit) << r.what;
}

TEST_F(RadianceFlatsTest, FindsTheExposureTimes) {
  // 0.02 s is in truth 5 % longer.
  for (std::size_t i : {4U, 5U}) {
    const RadianceShot longer = bench_.shot("longer", 0.021, slanted);
    bench_.frames.at(longer.file).exposure_s = 0.02;
    bench_.input.shots.flats[i].file = longer.file;
  }
  find_response_and_noise(bench_.steps);
  const auto& shutter = bench_.calibration.correction.shutter;
  ASSERT_EQ(shutter.size(), 6U);
  // The mean of the logs is 0 by convention.
  const double common = std::log(1.05) / 6;
  double mean = 0;
  for (std::size_t s = 0; s < 6; ++s) {
    const double expected = (s == 2 ? std::log(1.05) : 0.0) - common;
    EXPECT_NEAR(std::log(shutter[s].true_over_stated), expected,
                4.5 * std::max(shutter[s].relative_std, 5e-4))
        << s;
    mean += std::log(shutter[s].true_over_stated);
  }
  EXPECT_NEAR(mean, 0.0, 1e-9);
}

TEST_F(RadianceFlatsTest, LeavesTheLightOfEachBlock) {
  find_response_and_noise(bench_.steps);
  ASSERT_EQ(bench_.steps.light.size(), bench_.steps.blocks.size());
  double sum = 0;
  for (std::size_t k = 0; k < bench_.steps.light.size(); ++k) {
    const Block& b = bench_.steps.blocks[k];
    // Mean column of the block's samples.
    const double x = b.x0 + 7.0;
    const RadianceSteps::Light& l = bench_.steps.light[k];
    const double off = std::log(l.per_s / (15'000.0 + 80.0 * x));
    sum += off;
    EXPECT_NEAR(off, 0.0, 0.01) << k;
    EXPECT_GT(l.relative_variance, 0.0);
    EXPECT_GT(l.samples, 0.0);
  }
  EXPECT_NEAR(sum / static_cast<double>(bench_.steps.light.size()), 0.0, 0.005);
  EXPECT_EQ(bench_.steps.settings_s.size(), 6U);
}

TEST_F(RadianceFlatsTest, NotesThatTheReadNoiseRestsOnTheFlats) {
  bench_.input.shots.dark.clear();
  find_response_and_noise(bench_.steps);
  ASSERT_EQ(bench_.calibration.notes.size(), 1U);
  EXPECT_THAT(bench_.calibration.notes[0], HasSubstr("rests on the flats alone"));
}

TEST_F(RadianceFlatsTest, RefusesAPairThatIsOneFrameTwice) {
  for (auto& [file, frame] : bench_.frames) {
    if (file.starts_with("flat")) std::fill(frame.samples.begin(), frame.samples.end(), 500);
  }
  EXPECT_THAT(refusal_of([&] { find_response_and_noise(bench_.steps); }),
              HasSubstr("does not grow with the light"));
}

}  // namespace
}  // namespace scattermeter::calib
