#include "apps/planning/shot_forecaster.h"

#include <memory>
#include <optional>

#include <gtest/gtest.h>

#include "apps/instrument/instrument.h"
#include "apps/simulation/virtual_shots.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

// A plastic cube under two LEDs, its shots opened as `plan` does.
class ShotForecasterTest : public ::testing::Test {
 protected:
  static constexpr double kRangeCounts = 4031.0;
  ShotForecasterTest() {
    rig_.scene.surroundings.plane.emplace();  // exactly black
    rig_.truth.materials["plastic"].fill({0.5, 0.004, 1.0});
    const VirtualShots shots(rig_, objects_, {.noise = false});
    Instrument instrument(rig_, objects_, {});
    const capture::FrameSource frames = [&](std::size_t i, std::size_t k) {
      return shots.expected_frame(i, k);
    };
    measured_ = instrument.forecast(
        capture::shots_from(rig_.scene, capture::all_shots(rig_.scene), frames), opened_);
    std::array<SensorNoise, kRgb> noise;
    noise.fill(rig_.scene.camera.sensor.noise);
    forecaster_ = std::make_unique<ShotForecaster>(
        rig_, objects_, opened_, 1.5, measured_.patch_size_mm.at("cube"),
        *rig_.scene.camera.responsivity, noise, kRangeCounts);
    material_ = {"plastic", 1, rig_.truth.materials["plastic"], 1.4};
  }
  std::optional<ForecastStd> forecast(const std::vector<CandidateShot>& shots,
                                      double noise_inflation = 1.0) {
    ViewWeights lit;
    forecaster_->add_lights(shots, lit);
    return forecaster_->forecast(rig_, material_, shots, lit, {}, noise_inflation);
  }
  Rig rig_ = body_rig("cube", 2);
  ObjectScenes objects_ = bodies_scenes(rig_);
  std::vector<ObservedShot> opened_;
  Measurement measured_;
  std::unique_ptr<ShotForecaster> forecaster_;
  ExpectedMaterial material_;
};

TEST_F(ShotForecasterTest, IsNearTheEstimatorsOwn) {
  const std::vector<CandidateShot> shots = forecaster_->shots_of("plastic");
  ASSERT_EQ(shots.size(), 2U);
  EXPECT_EQ(shots[0].stated.file, "plastic_cube_1.dng");
  EXPECT_EQ(shots[0].like, &opened_[0]);
  EXPECT_EQ(shots[0].exposures_s.size(), 1U);
  EXPECT_TRUE(forecaster_->shots_of("glass").empty());
  const auto coarse = forecast(shots);
  ASSERT_TRUE(coarse.has_value());
  const Estimate& e = measured_.results.at(1).estimate;
  EXPECT_GT(coarse->sigma_a_per_mm, 0.6 * e.sigma_a_per_mm.std);
  EXPECT_LT(coarse->sigma_a_per_mm, 1.7 * e.sigma_a_per_mm.std);
  EXPECT_GT(coarse->sigma_s_prime_per_mm, 0.6 * e.sigma_s_prime_per_mm.std);
  EXPECT_LT(coarse->sigma_s_prime_per_mm, 1.7 * e.sigma_s_prime_per_mm.std);
}

// More noise is never better, and less than noise alone would have it: sqrt(100) at most.
TEST_F(ShotForecasterTest, MoreNoiseAndFewerShotsKnowLess) {
  const std::vector<CandidateShot> both = forecaster_->shots_of("plastic");
  const auto two = forecast(both);
  const auto one = forecast({both[0]});
  const auto noisy = forecast(both, 100.0);
  ASSERT_TRUE(two && one && noisy);
  EXPECT_GT(one->sigma_a_per_mm, two->sigma_a_per_mm);
  EXPECT_GT(noisy->sigma_a_per_mm, two->sigma_a_per_mm);
  EXPECT_LE(noisy->sigma_a_per_mm, 10.0 * two->sigma_a_per_mm * (1.0 + 1e-9));
}

TEST_F(ShotForecasterTest, WhatClipsTellsNothing) {
  std::vector<CandidateShot> shots = forecaster_->shots_of("plastic");
  const auto as_planned = forecast(shots);
  // A second, longer file of the bracket adds photons where it does not clip.
  shots[0].exposures_s.push_back(1000.0);
  const auto with_clipped = forecast(shots);
  ASSERT_TRUE(as_planned && with_clipped);
  EXPECT_NEAR(with_clipped->sigma_a_per_mm, as_planned->sigma_a_per_mm,
              1e-6 * as_planned->sigma_a_per_mm);
  for (CandidateShot& shot : shots) shot.exposures_s = {1000.0};
  EXPECT_FALSE(forecast(shots).has_value());
}

TEST_F(ShotForecasterTest, AnLedThatShinesAwayLightsNothing) {
  SceneLight led = rig_.scene.lights[0];
  led.name = "other";
  ViewWeights lit;
  EXPECT_TRUE(forecaster_->add_led(*forecaster_->seen("cube"), led, lit));
  EXPECT_EQ(lit.weights.size(), 1U);
  led.led()->led.axis *= -1.0;
  ViewWeights none;
  EXPECT_FALSE(forecaster_->add_led(*forecaster_->seen("cube"), led, none));
  EXPECT_TRUE(none.weights.empty());
}

}  // namespace
}  // namespace scattermeter::apps
