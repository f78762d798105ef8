#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/radiance/radiance_steps.h"
#include "tests/fixtures/calib/radiance_bench.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

constexpr double kResponsivity = 3e9;  // counts mm^2 sr / (W s)

// A white plane, 40 x 30 mm, 200 mm below a camera that looks straight down, under an LED.
class RadianceScaleTest : public ::testing::Test {
 protected:
  RadianceScaleTest() {
    bench_.know_dark();
    white_.plane.origin_mm = {-20, -15, 0};
    white_.plane.width_mm = 40;
    white_.plane.height_mm = 30;
    white_.plane.albedo = {0.9, 0.95, 0.85};
    white_.plane.albedo_relative_std = 0.01;
    white_.light = "led";
    white_.line = 20;
    PriorLed led;
    led.name = "led";
    led.led.position_mm = {20, 10, 90};
    led.led.exponent = 1.0;
    led.led.intensity_W_per_sr = {0.02, 0.03, 0.025};
    bench_.input.white_led = led;
    pose_.status = PoseStatus::kOk;
    pose_.camera_from_world.rotation = Eigen::Quaterniond(0, 1, 0, 0);
    pose_.camera_from_world.translation_mm = {0, 0, 200};
    bench_.input.pose.estimate = [this](const capture::RawFrame&, const std::string&) {
      return pose_;
    };
    bench_.steps.settings_s = {0.1};
    bench_.steps.response_covariance = Eigen::MatrixXd::Zero(1, 1);
  }

  RadianceShot white_shot(double exposure_s) {
    return bench_.shot(
        "white", exposure_s,
        [this](int x, int y) {
          const Eigen::Vector3d p((x - 47.5), -(y - 31.5), 0.0);  // 200 mm over 200 px
          if (std::abs(p.x()) > 20 || std::abs(p.y()) > 15) return 0.0;
          const auto c = static_cast<Eigen::Index>(CfaPattern{}.at(x, y));
          const Led& led = bench_.input.white_led->led;
          const Eigen::Vector3d to_led = led.position_mm - p;
          const double cosine = to_led.z() / to_led.norm();  // of the lobe as well
          return kResponsivity * white_.plane.albedo[c] * led.intensity_W_per_sr[c] * cosine *
                 cosine / (M_PI * to_led.squaredNorm());
        },
        1.0, false);
  }
  void find(const std::vector<RadianceShot>& shots) {
    white_.shots = shots;
    bench_.input.shots.white = white_;
    find_scale(bench_.steps);
  }

  RadianceBench bench_;
  WhiteReference white_;
  PoseResult pose_;
};

TEST_F(RadianceScaleTest, IsCountsOverRadiance) {
  find({white_shot(0.1)});
  ASSERT_TRUE(bench_.calibration.responsivity);
  for (std::size_t c = 0; c < kRgb; ++c) {
    EXPECT_NEAR((*bench_.calibration.responsivity)[c] / kResponsivity, 1.0, 1e-3) << c;
  }
  // The albedo's error, and little noise.
  EXPECT_GT(bench_.calibration.responsivity_relative_std, 0.01);
  EXPECT_LT(bench_.calibration.responsivity_relative_std, 0.0105);
}

TEST_F(RadianceScaleTest, TheLedsErrorsCount) {
  bench_.input.white_led->power_relative_std = 0.03;
  bench_.input.white_led->position_std_mm = 1.0;
  find({white_shot(0.1)});
  // Of the height alone: 1 mm of some 90 by the inverse square and two cosines, 2 % at the most.
  EXPECT_GT(bench_.calibration.responsivity_relative_std, std::hypot(0.01, 0.03, 0.005));
  EXPECT_LT(bench_.calibration.responsivity_relative_std, std::hypot(0.01, 0.03, 0.03));
}

// A lobe of exponent 1 tilted by a: towards the plane, some 15 degrees off its axis, by a tan(15).
TEST_F(RadianceScaleTest, TheLedsAxisCounts) {
  const auto variance = [&](double axis_std_rad) {
    bench_.input.white_led->axis_std_rad = axis_std_rad;
    find({white_shot(0.1)});
    return std::pow(bench_.calibration.responsivity_relative_std, 2);
  };
  constexpr double kStd_rad = 0.02;
  const double by_axis = kStd_rad * std::hypot(20.0, 10.0) / 90.0;
  EXPECT_NEAR(std::sqrt(variance(kStd_rad) - variance(0.0)), by_axis, 0.1 * by_axis);
}

// Of a calibrated LED, with the correlations: its power is known relative to its distance.
TEST_F(RadianceScaleTest, ACalibratedLedsErrorsCount) {
  PriorLed& led = *bench_.input.white_led;
  led.position_std_mm = 5.0;  // before it was calibrated
  LedUncertainty& u = led.calibrated.emplace();
  u.tangents = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  u.covariance(2, 2) = 1.0;
  find({white_shot(0.1)});
  const double by_height =
      std::sqrt(std::pow(bench_.calibration.responsivity_relative_std, 2) - std::pow(0.01, 2));
  EXPECT_GT(by_height, 0.01);
  const double std = 0.04;
  for (Eigen::Index c = 0; c < 3; ++c) u.covariance(6 + c, 6 + c) = std * std;
  find({white_shot(0.1)});
  EXPECT_NEAR(bench_.calibration.responsivity_relative_std, std::hypot(0.01, by_height, std), 1e-4);
  // Farther and as much stronger: the same light on the plane.
  for (Eigen::Index c = 0; c < 3; ++c) u.covariance(6 + c, 2) = u.covariance(2, 6 + c) = by_height;
  for (Eigen::Index c = 0; c < 3; ++c) u.covariance(6 + c, 6 + c) = by_height * by_height;
  find({white_shot(0.1)});
  EXPECT_NEAR(bench_.calibration.responsivity_relative_std, 0.01, 3e-4);
}

TEST_F(RadianceScaleTest, AnUnknownExposureTimeCounts) {
  bench_.calibration.correction.shutter_relative_std = 0.02;
  find({white_shot(0.11)});
  EXPECT_GT(bench_.calibration.responsivity_relative_std, std::hypot(0.01, 0.02));
  EXPECT_LT(bench_.calibration.responsivity_relative_std, std::hypot(0.01, 0.021));
}

TEST_F(RadianceScaleTest, AClippedShotIsLeftOut) {
  find({white_shot(2.0), white_shot(0.1)});
  EXPECT_NEAR((*bench_.calibration.responsivity)[1] / kResponsivity, 1.0, 1e-3);
  ASSERT_EQ(bench_.calibration.notes.size(), 1U);
  EXPECT_THAT(bench_.calibration.notes[0], HasSubstr("clipped"));
  EXPECT_THAT(refusal_of([&] { find({white_shot(2.0)}); }), HasSubstr("white reference, channel"));
}

TEST_F(RadianceScaleTest, RefusesAPlaneOutOfViewAndNotesThatThereIsNone) {
  white_.plane.origin_mm.x() = 500;
  EXPECT_THAT(refusal_of([&] { find({white_shot(0.1)}); }),
              HasSubstr("rig.yaml:20: calibration.radiance.white"));
  bench_.input.shots.white.reset();
  bench_.calibration = {};
  find_scale(bench_.steps);
  EXPECT_FALSE(bench_.calibration.responsivity);
  ASSERT_EQ(bench_.calibration.notes.size(), 1U);
  EXPECT_THAT(bench_.calibration.notes[0], HasSubstr("no white reference"));
}

}  // namespace
}  // namespace scattermeter::calib
