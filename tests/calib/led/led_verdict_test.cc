#include "calib/led/led_verdict.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/led_scenes.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

// An LED 100 mm above the only cell, known to 0.1 mm, 1 mrad, 0.01 and 1 %.
struct Judged {
  LedScene scene;
  LedSolve what;
  LedFitOptions options;
  LedFit fit;

  Judged() {
    scene.planes.resize(1);
    scene.cells.resize(1);
    what.use_cell = {true};
    what.free.fill(true);
    fit.led = true_led();
    fit.led.position_mm = scene.cell_mm(scene.cells[0]) + Eigen::Vector3d(0, 0, 100);
    fit.lobe_fitted = true;
    LedMatrix& c = fit.uncertainty.covariance;
    c.diagonal() << 1e-2, 1e-2, 1e-2, 1e-6, 1e-6, 1e-4, 1e-4, 1e-4, 1e-4;
  }
  const LedFit& judge() {
    fit.warnings.clear();
    judge_led(scene, what, options, fit);
    return fit;
  }
};

TEST(LedVerdict, AGoodFitIsOk) {
  Judged j;
  const LedFit& fit = j.judge();
  EXPECT_EQ(fit.status, LedStatus::kOk);
  EXPECT_TRUE(fit.warnings.empty());
  EXPECT_DOUBLE_EQ(fit.distance_mm, 100.0);
  EXPECT_DOUBLE_EQ(fit.distance_std_mm, 0.1);
  EXPECT_EQ(fit.distance_power_correlation, 0.0);
}

TEST(LedVerdict, HighlightsThatDoNotFitAreRefused) {
  Judged j;
  j.fit.highlight_rms_px = 0.9;
  EXPECT_EQ(j.judge().status, LedStatus::kOk);
  j.fit.highlight_rms_px = 2.58;
  EXPECT_EQ(j.judge().status, LedStatus::kMisfit);
  EXPECT_THAT(j.fit.message, HasSubstr("2.6 px off"));
}

TEST(LedVerdict, PowerIsTheMeanOfTheFreeChannels) {
  Judged j;
  j.what.free[kLedLogIntensity + 2] = false;
  LedMatrix& c = j.fit.uncertainty.covariance;
  // Two channels, independent but for the same tie to the height: deviation of their mean
  // 0.01 / sqrt 2.
  for (Eigen::Index k = 0; k < 2; ++k) {
    c(2, kLedLogIntensity + k) = c(kLedLogIntensity + k, 2) = 0.5 * 0.1 * 0.01;
  }
  EXPECT_NEAR(j.judge().distance_power_correlation, 0.5 * std::sqrt(2.0), 1e-12);
}

TEST(LedVerdict, RefusesEachUncertaintyAboveItsLimit) {
  Judged position;
  position.fit.uncertainty.covariance(0, 0) = 5.1 * 5.1;
  EXPECT_EQ(position.judge().status, LedStatus::kIllConditioned);
  EXPECT_THAT(position.fit.message, HasSubstr("position is known to 5.1 mm only"));
  position.fit.uncertainty.covariance(0, 0) = 4.9 * 4.9;
  EXPECT_EQ(position.judge().status, LedStatus::kOk);
  Judged axis;
  axis.fit.uncertainty.covariance(kLedAxis + 1, kLedAxis + 1) = 0.11 * 0.11;
  EXPECT_EQ(axis.judge().status, LedStatus::kIllConditioned);
  EXPECT_THAT(axis.fit.message, HasSubstr("0.11 rad"));
  Judged exponent;  // of 1.3: limit 0.39
  exponent.fit.uncertainty.covariance(kLedExponent, kLedExponent) = 0.4 * 0.4;
  EXPECT_EQ(exponent.judge().status, LedStatus::kIllConditioned);
  exponent.fit.uncertainty.covariance(kLedExponent, kLedExponent) = 0.38 * 0.38;
  EXPECT_EQ(exponent.judge().status, LedStatus::kOk);
}

TEST(LedVerdict, WarnsOfDistanceTiedToPower) {
  Judged j;
  LedMatrix& c = j.fit.uncertainty.covariance;
  c(2, 2) = 0.25;  // half a per cent of the distance
  for (Eigen::Index a = 0; a < 3; ++a) {
    for (Eigen::Index b = 0; b < 3; ++b) c(kLedLogIntensity + a, kLedLogIntensity + b) = 1e-4;
    c(2, kLedLogIntensity + a) = c(kLedLogIntensity + a, 2) = 0.99 * 0.5 * 0.01;
  }
  ASSERT_EQ(j.judge().status, LedStatus::kOk);
  ASSERT_EQ(j.fit.warnings.size(), 1U);
  EXPECT_THAT(j.fit.warnings[0], HasSubstr("hardly separates distance from power"));
  EXPECT_NEAR(j.fit.distance_power_correlation, 0.99, 1e-12);
  // The same tie does not matter where the distance is known to less than 0.3 %.
  const double smaller = 0.2 / 0.5;
  c.row(2) *= smaller;
  c.col(2) *= smaller;
  EXPECT_TRUE(j.judge().warnings.empty());
}

TEST(LedVerdict, WarnsOfWhatWasLeftOut) {
  Judged j;
  j.fit.lobe_fitted = false;
  j.fit.highlight_used = {true, false, false};
  ASSERT_EQ(j.judge().status, LedStatus::kOk);
  ASSERT_EQ(j.fit.warnings.size(), 2U);
  EXPECT_THAT(j.fit.warnings[0], HasSubstr("no white plane"));
  EXPECT_THAT(j.fit.warnings[1], HasSubstr("2 highlight(s)"));
}

TEST(LedVerdict, NamesCombinations) {
  Eigen::VectorXd v = Eigen::VectorXd::Zero(kLedParameters + 3);
  v[1] = 1.0;
  v[kLedLogIntensity] = 1.0;
  v[kLedExponent] = 0.2;  // 2 % of the whole
  EXPECT_EQ(combination_name(v), "position, power");
  v[kLedParameters] = 1.0;
  EXPECT_EQ(combination_name(v), "position, power, ambient light");
}

TEST(LedVerdict, AdvisesAShotWithoutTheLedWhereAmbientLightIsFree) {
  LedSolve what;
  what.free_ambient = {false, false};
  EXPECT_THAT(layout_advice(what), ::testing::StartsWith("add spheres"));
  what.free_ambient = {false, true};
  EXPECT_THAT(layout_advice(what), HasSubstr("LED off"));
}

TEST(LedVerdict, ARefusalHasNoWarnings) {
  LedFit fit;
  fit.warnings = {"something"};
  refuse_led(fit, LedStatus::kMisfit, "why");
  EXPECT_EQ(fit.status, LedStatus::kMisfit);
  EXPECT_EQ(fit.message, "why");
  EXPECT_TRUE(fit.warnings.empty());
}

}  // namespace
}  // namespace scattermeter::calib
