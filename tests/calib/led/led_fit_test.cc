#include "calib/led/led_fit.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include "tests/fixtures/calib/led_scenes.h"
#include "tests/fixtures/draws.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

LedVector difference(const LedFit& fit, const Led& truth) {
  LedVector d;
  d.head<3>() = fit.led.position_mm - truth.position_mm;
  for (Eigen::Index t = 0; t < 2; ++t) {
    d[kLedAxis + t] = -fit.uncertainty.tangents[static_cast<std::size_t>(t)].dot(truth.axis);
  }
  d[kLedExponent] = fit.led.exponent - truth.exponent;
  for (Eigen::Index c = 0; c < 3; ++c) {
    d[kLedLogIntensity + c] = std::log(fit.led.intensity_W_per_sr[c] / truth.intensity_W_per_sr[c]);
  }
  return d;
}

Led wrong_start() {
  Led start = true_led();
  start.position_mm += Eigen::Vector3d(12, -10, 12);  // 20 mm
  start.axis = (start.axis + Eigen::Vector3d(0.2, -0.1, 0.0)).normalized();
  start.exponent = 1.0;
  start.intensity_W_per_sr.setOnes();
  return start;
}

TEST(LedFit, RecoversTheTruthWithoutNoise) {
  LedSceneOptions exact;
  exact.rotation_std_rad = exact.translation_std_mm = exact.center_std_mm = 0.0;
  exact.albedo_std = exact.highlight_std_px = exact.cell_relative_std = 0.0;
  for (bool spheres : {true, false}) {
    exact.spheres = spheres;
    const LedFit fit = fit_led(draw_led_scene(true_led(), exact, 1), wrong_start());
    ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
    const LedVector d = difference(fit, true_led());
    EXPECT_LT(d.head<3>().norm(), 2e-3) << d.transpose();
    EXPECT_LT(std::abs(d[kLedExponent]), 2e-4);
    EXPECT_LT(d.tail<3>().norm(), 1e-4);
  }
}

// A table that is too wide or too narrow is corrected by a power: tables of cosine powers 1 and 1.5
// for an LED of 1.3.
TEST(LedFit, CorrectsATable) {
  LedSceneOptions exact;
  exact.rotation_std_rad = exact.translation_std_mm = exact.center_std_mm = 0.0;
  exact.albedo_std = exact.highlight_std_px = exact.cell_relative_std = 0.0;
  for (const double tabulated : {1.0, 1.5}) {
    std::vector<double> angles_rad, relative;
    for (int k = 0; k <= 90; ++k) {
      angles_rad.push_back(k * std::numbers::pi / 180.0);
      relative.push_back(k == 90 ? 0.0 : std::pow(std::cos(angles_rad.back()), tabulated));
    }
    Led start = wrong_start();
    start.table = std::make_shared<LobeTable>(angles_rad, relative);
    start.exponent = 0.0;
    const LedFit fit = fit_led(draw_led_scene(true_led(), exact, 1), start);
    ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
    EXPECT_NEAR(fit.led.exponent, 1.3 - tabulated, 2e-3);
    EXPECT_LT((fit.led.position_mm - true_led().position_mm).norm(), 0.02);
    EXPECT_TRUE(((fit.led.intensity_W_per_sr - true_led().intensity_W_per_sr).abs() <
                 1e-3 * true_led().intensity_W_per_sr)
                    .all());
  }
}

// Bias and deviation of every parameter over drawn poses, spheres, albedos and noise.
void hold_statistics(const LedSceneOptions& options, int few, int many, double position_limit_mm) {
  const int seeds = test_support::draws(few, many);
  const auto n_seeds = static_cast<std::size_t>(seeds);
  const double limit = test_support::limit_at(0.2, many, seeds);
  const auto n = static_cast<double>(n_seeds);
  std::vector<LedVector> off(n_seeds);
  std::vector<LedMatrix> covariance(n_seeds);
  std::vector<char> ok(n_seeds, 0);
  const Led truth = true_led();
  tbb::parallel_for(std::size_t{0}, n_seeds, [&](std::size_t i) {
    const LedFit fit = fit_led(draw_led_scene(truth, options, i + 1), wrong_start());
    ok[i] = fit.status == LedStatus::kOk ? 1 : 0;
    off[i] = difference(fit, truth);
    covariance[i] = fit.uncertainty.covariance;
  });
  LedVector mean = LedVector::Zero(), square = LedVector::Zero(), predicted = LedVector::Zero();
  double mahalanobis = 0.0, worst_mm = 0.0;
  for (std::size_t i = 0; i < n_seeds; ++i) {
    ASSERT_TRUE(ok[i]) << i;
    mean += off[i] / n;
    square += off[i].cwiseAbs2() / n;
    predicted += covariance[i].diagonal() / n;
    mahalanobis += off[i].dot(covariance[i].ldlt().solve(off[i])) / (9.0 * n);
    worst_mm = std::max(worst_mm, off[i].head<3>().norm());
  }
  for (Eigen::Index k = 0; k < 9; ++k) {
    const double sampled = std::sqrt((square[k] - mean[k] * mean[k]) * n / (n - 1.0));
    // 3.5 deviations of a mean; a ratio of deviations scatters by 5 to 7 %.
    EXPECT_LT(std::abs(mean[k]), 3.5 * sampled / std::sqrt(n)) << k;
    EXPECT_NEAR(std::sqrt(predicted[k]) / sampled, 1.0, limit) << k;
    std::printf("parameter %td: sampled %.3g, predicted/sampled %.2f\n", k, sampled,
                std::sqrt(predicted[k]) / sampled);
  }
  EXPECT_NEAR(mahalanobis, 1.0, limit);
  EXPECT_LT(worst_mm, position_limit_mm);
  // The exponent within 2 % at three deviations.
  EXPECT_LT(3.0 * std::sqrt(predicted[kLedExponent]), 0.02 * truth.exponent);
}

TEST(LedFitStatistics, UncertaintyIsThatOfTheDraws) {
  LedSceneOptions both;
  both.planes = 2;
  hold_statistics(both, 30, 150, 0.2);
}

TEST(LedFitStatistics, UncertaintyOfPlanesAloneIsThatOfTheDraws) {
  LedSceneOptions planes;
  planes.spheres = false;
  planes.planes = 2;
  hold_statistics(planes, 20, 100, 0.25);
}

TEST(LedFit, SpheresAloneGiveThePlace) {
  LedSceneOptions spheres;
  spheres.planes = 0;
  LedFitOptions options;
  options.exponent_std = 0.1;
  const LedFit fit = fit_led(draw_led_scene(true_led(), spheres, 3), wrong_start(), options);
  ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
  EXPECT_FALSE(fit.lobe_fitted);
  EXPECT_EQ(fit.led.exponent, wrong_start().exponent);
  EXPECT_DOUBLE_EQ(fit.uncertainty.covariance(kLedExponent, kLedExponent), 0.01);
  EXPECT_LT((fit.led.position_mm - true_led().position_mm).norm(), 0.3);
  ASSERT_FALSE(fit.warnings.empty());
  EXPECT_THAT(fit.warnings.front(), HasSubstr("no white plane"));
}

TEST(LedFit, AlbedoMovesThePowerAlone) {
  const LedFit fit = fit_led(draw_led_scene(true_led(), {}, 4), wrong_start());
  ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
  const LedVector& common = fit.uncertainty.common;
  for (Eigen::Index c = 0; c < 3; ++c) EXPECT_NEAR(common[kLedLogIntensity + c], -0.005, 2e-4);
  EXPECT_LT(common.head<3>().norm(), 1e-3);
  const LedMatrix own = fit.uncertainty.covariance - common * common.transpose();
  EXPECT_GT(own.ldlt().vectorD().minCoeff(), 0.0);
}

TEST(LedFit, AHighlightThatIsSomethingElseIsLeftOut) {
  LedScene scene = draw_led_scene(true_led(), {}, 5);
  scene.highlights[2].image_px += Eigen::Vector2d(15, -9);
  const LedFit fit = fit_led(scene, wrong_start());
  ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
  EXPECT_FALSE(fit.highlight_used[2]);
  EXPECT_LT((fit.led.position_mm - true_led().position_mm).norm(), 0.2);
}

TEST(LedFit, ShadowsOnThePlaneAreLeftOut) {
  LedScene scene = draw_led_scene(true_led(), {}, 6);
  for (ShadedCell& cell : scene.cells) {
    if (cell.column < 4 && cell.row < 4) cell.radiance_W_per_mm2_sr *= 0.3;
    if (cell.column == 4 && cell.row < 4) cell.radiance_W_per_mm2_sr *= 0.9;  // half shadow
    if (cell.column == 8 && cell.row == 6) cell.radiance_W_per_mm2_sr *= 0.97;
  }
  const LedFit fit = fit_led(scene, wrong_start());
  ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
  for (std::size_t i = 0; i < scene.cells.size(); ++i) {
    const ShadedCell& cell = scene.cells[i];
    if ((cell.column <= 4 && cell.row < 4) || (cell.column == 8 && cell.row == 6)) {
      EXPECT_FALSE(fit.cell_used[i]) << cell.column << " " << cell.row;
    }
  }
  EXPECT_LT((fit.led.position_mm - true_led().position_mm).norm(), 0.2);
  EXPECT_NEAR(fit.led.exponent, 1.3, 0.02);
}

TEST(LedFit, WidensWhereThePlaneIsNotAsTheModel) {
  LedScene scene = draw_led_scene(true_led(), {}, 7);
  const LedFit even = fit_led(scene, wrong_start());
  for (ShadedCell& cell : scene.cells) {
    cell.radiance_W_per_mm2_sr *= 1.0 + 0.02 * std::sin(0.9 * cell.column) * std::cos(cell.row);
  }
  const LedFit fit = fit_led(scene, wrong_start());
  ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
  EXPECT_GT(fit.plane_inflation, 10.0);
  EXPECT_GT(fit.uncertainty.covariance(kLedExponent, kLedExponent),
            3.0 * even.uncertainty.covariance(kLedExponent, kLedExponent));
  EXPECT_FALSE(fit.warnings.empty());
}

// A small plane far below the LED and frontal to it: the shading hardly bends, and a brighter LED
// farther away shades it alike.
TEST(LedFit, RefusesAFarFrontalPlane) {
  LedSceneOptions far;
  far.spheres = false;
  far.plane_size = 0.5;
  Led truth = true_led();
  truth.position_mm = {0, 0, 500};
  truth.axis = -Eigen::Vector3d::UnitZ();
  Led start = truth;
  start.position_mm.z() = 480;
  const LedFit fit = fit_led(draw_led_scene(truth, far, 8), start);
  EXPECT_TRUE(fit.status == LedStatus::kIllConditioned || fit.status == LedStatus::kUndetermined);
  EXPECT_THAT(fit.message, HasSubstr("power"));
}

// Nearer and larger, it just tells: with a warning, and with the truth inside.
TEST(LedFit, WarnsWhereDistanceAndPowerAreTied) {
  LedSceneOptions near;
  near.spheres = false;
  near.cell_relative_std = 1e-3;
  Led truth = true_led();
  truth.position_mm = {5, 3, 110};
  truth.axis = Eigen::Vector3d(0.02, 0.01, -1).normalized();
  const LedFit fit = fit_led(draw_led_scene(truth, near, 9), truth);
  ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
  EXPECT_GT(std::abs(fit.distance_power_correlation), 0.9);
  ASSERT_FALSE(fit.warnings.empty());
  EXPECT_THAT(fit.warnings.front(), HasSubstr("distance from power"));
  LedSceneOptions two = near;
  two.planes = 3;
  const LedFit better = fit_led(draw_led_scene(truth, two, 9), truth);
  ASSERT_EQ(better.status, LedStatus::kOk) << better.message;
  EXPECT_LT(better.distance_std_mm, 0.5 * fit.distance_std_mm);
}

TEST(LedFit, SaysWhatIsMissing) {
  LedSceneOptions none;
  none.planes = 0;
  LedScene scene = draw_led_scene(true_led(), none, 10);
  scene.highlights.resize(1);
  const LedFit one = fit_led(scene, true_led());
  EXPECT_EQ(one.status, LedStatus::kTooFewData);
  EXPECT_THAT(one.message, HasSubstr("two spheres"));
  scene.highlights.clear();
  EXPECT_EQ(fit_led(scene, true_led()).status, LedStatus::kTooFewData);
}

TEST(LedFit, APlaneInTheWrongPlaceIsAMisfit) {
  LedScene scene = draw_led_scene(true_led(), {}, 11);
  // Half of it in other light.
  for (ShadedCell& cell : scene.cells) {
    cell.radiance_W_per_mm2_sr *= 1.0 + 0.2 * std::sin(1.7 * cell.column + 2.3 * cell.row);
  }
  const LedFit fit = fit_led(scene, wrong_start());
  if (fit.status == LedStatus::kOk) {
    EXPECT_GT(fit.plane_inflation, 1e4);
  } else {
    EXPECT_FALSE(fit.message.empty());
  }
}

TEST(LedFit, AChannelWithoutLightHasNoPower) {
  Led truth = true_led();
  truth.intensity_W_per_sr[2] = 0.0;
  LedScene scene = draw_led_scene(truth, {}, 12);
  for (ShadedCell& cell : scene.cells) {
    if (cell.channel == 2) cell.std_W_per_mm2_sr = 1e-9;
  }
  const LedFit fit = fit_led(scene, wrong_start());
  ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
  EXPECT_EQ(fit.led.intensity_W_per_sr[2], 0.0);
  EXPECT_NEAR(fit.led.intensity_W_per_sr[0], 0.05, 0.05 * 0.02);
}

TEST(LedFit, RefusesBadOptions) {
  LedFitOptions options;
  options.inlier_px = 0.0;
  EXPECT_THROW(options.Check(), std::invalid_argument);
  options = {};
  options.exponent_std = -1.0;
  EXPECT_THROW(options.Check(), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
