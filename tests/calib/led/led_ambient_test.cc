#include "calib/led/led_ambient.h"

#include <array>
#include <cmath>
#include <cstdio>

#include <Eigen/Cholesky>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/parallel_for.h>

#include "tests/fixtures/calib/led_scenes.h"
#include "tests/fixtures/draws.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

// 5 % of the LED's irradiance in the middle of the lower plane, a little more blue than the LED.
LedSceneOptions five_percent() {
  LedSceneOptions options;
  options.planes = 2;
  const double one = true_led().transmitted_irradiance_per_mm2({0, 0, 0}, {0, 0, 1}, 1.0);
  options.ambient_irradiance_W_per_mm2 =
      0.05 * one * true_led().intensity_W_per_sr * Eigen::Array3d(0.9, 1.0, 1.2);
  return options;
}

LedFit fit_with(const LedScene& scene, AmbientModel model) {
  LedFitOptions options;
  options.ambient = model;
  return fit_led(scene, true_led(), options);
}

struct Spread {
  Eigen::Vector3d mean_mm = Eigen::Vector3d::Zero();
  double mahalanobis = 0;  // mean of d' C^-1 d of the place, over 3
  double predicted_std_mm = 0, sampled_std_mm = 0;
  std::size_t refused = 0;
};

Spread place_spread(const LedSceneOptions& options, AmbientModel model, std::size_t n) {
  std::vector<LedFit> fits(n);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) {
    fits[i] = fit_with(draw_led_scene(true_led(), options, i + 1), model);
  });
  Spread out;
  double squares = 0.0, variances = 0.0;
  for (const LedFit& fit : fits) {
    if (fit.status != LedStatus::kOk) {
      ++out.refused;
      continue;
    }
    const Eigen::Vector3d d = fit.led.position_mm - true_led().position_mm;
    const Eigen::Matrix3d c = fit.uncertainty.covariance.topLeftCorner<3, 3>();
    out.mean_mm += d / static_cast<double>(n);
    out.mahalanobis += d.dot(c.ldlt().solve(d)) / (3.0 * static_cast<double>(n));
    squares += d.squaredNorm() / static_cast<double>(n);
    variances += c.trace() / static_cast<double>(n);
  }
  out.sampled_std_mm = std::sqrt(squares);
  out.predicted_std_mm = std::sqrt(variances);
  return out;
}

void print(const std::string& name, const Spread& s) {
  std::printf("%s: mean %.4f mm off, rms %.4f mm, predicted %.4f mm, chi-square %.2f of 1\n",
              name.c_str(), s.mean_mm.norm(), s.sampled_std_mm, s.predicted_std_mm, s.mahalanobis);
}

TEST(LedAmbientStatistics, PlaceStaysUnbiasedAndAsUncertainAsItSays) {
  const int n = test_support::draws(15, 60);
  for (const bool spheres : {true, false}) {
    LedSceneOptions options = five_percent();
    options.spheres = spheres;
    const Spread s = place_spread(options, AmbientModel::kWhereSeen, static_cast<std::size_t>(n));
    print(spheres ? "spheres" : "planes", s);
    EXPECT_EQ(s.refused, 0U);
    // Three coordinates of 60 draws: chi^2 of 180 degrees of freedom, scattering by 10 %.
    EXPECT_NEAR(s.mahalanobis, 1.0, test_support::limit_at(0.35, 60, n)) << spheres;
    EXPECT_NEAR(s.predicted_std_mm / s.sampled_std_mm, 1.0, test_support::limit_at(0.2, 60, n))
        << spheres;
    // Told that there is none, the place is off by far more than it says, or nothing is said.
    const Spread blind = place_spread(options, AmbientModel::kNone, 8);
    print(spheres ? "blind_spheres" : "blind_planes", blind);
    EXPECT_TRUE(blind.refused == 8 || blind.mahalanobis > 2.0 * s.mahalanobis)
        << blind.mahalanobis << " " << blind.mean_mm.transpose();
  }
}

TEST(LedAmbient, ItIsFoundAndSaid) {
  const LedSceneOptions options = five_percent();
  const LedScene scene = draw_led_scene(true_led(), options, 3);
  const LedFit fit = fit_with(scene, AmbientModel::kWhereSeen);
  ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
  ASSERT_EQ(fit.ambient.size(), 2U);
  for (Eigen::Index c = 0; c < 3; ++c) {
    EXPECT_GT(fit.ambient[0].relative_std[c], 0.0);
    const double radiance =
        scene.planes[0].albedo[c] / M_PI * options.ambient_irradiance_W_per_mm2[c];
    EXPECT_NEAR(fit.ambient[0].radiance_W_per_mm2_sr[c] / radiance, 1.0,
                0.01 + 4.0 * fit.ambient[0].relative_std[c] / fit.ambient[0].relative[c]);
  }
  ASSERT_FALSE(fit.warnings.empty());
  EXPECT_THAT(fit.warnings.back(), HasSubstr("ambient light of up to"));
  const LedFit none = fit_with(scene, AmbientModel::kNone);
  EXPECT_TRUE(none.ambient.empty());
  EXPECT_GT(none.plane_inflation, 4.0);
  EXPECT_FALSE(none.warnings.empty());
}

TEST(LedAmbient, WithoutItNothingChanges) {
  LedSceneOptions dark;
  dark.planes = 2;
  for (std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const LedScene scene = draw_led_scene(true_led(), dark, seed);
    const LedFit seen = fit_with(scene, AmbientModel::kWhereSeen);
    const LedFit none = fit_with(scene, AmbientModel::kNone);
    EXPECT_TRUE(seen.ambient.empty());
    EXPECT_EQ(seen.led.position_mm, none.led.position_mm);
    // Asked for, it costs precision, and the covariance says so.
    const LedFit fitted = fit_with(scene, AmbientModel::kFitted);
    ASSERT_EQ(fitted.status, LedStatus::kOk) << fitted.message;
    EXPECT_GT(fitted.uncertainty.covariance(kLedExponent, kLedExponent),
              none.uncertainty.covariance(kLedExponent, kLedExponent));
  }
}

TEST(LedAmbient, WhatNoConstantExplainsIsNoAmbientLight) {
  LedSceneOptions dark;
  LedScene scene = draw_led_scene(true_led(), dark, 7);
  for (ShadedCell& cell : scene.cells) {
    cell.radiance_W_per_mm2_sr *= 1.0 + 0.02 * std::sin(0.9 * cell.column) * std::cos(cell.row);
  }
  const LedFit without = fit_with(scene, AmbientModel::kNone);
  const LedFit with = fit_with(scene, AmbientModel::kFitted);
  EXPECT_GT(without.plane_inflation, 10.0);
  EXPECT_FALSE(ambient_is_seen(scene, without, with));
}

TEST(LedAmbient, SubtractedShotsHaveNoConstant) {
  LedScene scene = draw_led_scene(true_led(), five_percent(), 5);
  const LedSceneOptions options = five_percent();
  for (ShadedCell& cell : scene.cells) {
    if (cell.shot == 1) {
      cell.radiance_W_per_mm2_sr -= scene.planes[1].albedo[cell.channel] / M_PI *
                                    options.ambient_irradiance_W_per_mm2[cell.channel];
    }
  }
  scene.ambient_subtracted = {false, true};
  const LedFit fit = fit_with(scene, AmbientModel::kFitted);
  ASSERT_EQ(fit.status, LedStatus::kOk) << fit.message;
  ASSERT_EQ(fit.ambient.size(), 1U);
  EXPECT_EQ(fit.ambient[0].shot, 0U);
  EXPECT_NEAR(fit.ambient[0].relative[1], 0.05, 0.02);
}

TEST(LedAmbient, CellsAreSubtractedWithTheirNoise) {
  PlaneCells lit, dark;
  lit.columns = 4;
  lit.rows = 2;
  dark.columns = 2;  // another pose: a coarser grid
  dark.rows = 1;
  for (int i = 0; i < 8; ++i) {
    ShadedCell cell;
    cell.column = i % 4;
    cell.row = i / 4;
    cell.channel = 1;
    cell.shot = 6;
    cell.radiance_W_per_mm2_sr = 10.0 + i;
    cell.std_W_per_mm2_sr = 3.0;
    lit.cells.push_back(cell);
  }
  ShadedCell left;
  left.channel = 1;
  left.radiance_W_per_mm2_sr = 2.0;
  left.std_W_per_mm2_sr = 4.0;
  dark.cells = {left};
  const PlaneCells out = without_ambient(lit, dark);
  // The right half has no dark cell.
  ASSERT_EQ(out.cells.size(), 4U);
  EXPECT_EQ(out.columns, 4);
  for (const ShadedCell& cell : out.cells) {
    EXPECT_LT(cell.column, 2);
    EXPECT_DOUBLE_EQ(cell.radiance_W_per_mm2_sr, 8.0 + 4 * cell.row + cell.column);
    EXPECT_DOUBLE_EQ(cell.std_W_per_mm2_sr, 5.0);
    EXPECT_EQ(cell.shot, 6U);
  }
}

}  // namespace
}  // namespace scattermeter::calib
