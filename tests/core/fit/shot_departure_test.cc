#include "core/fit/shot_departure.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr Eigen::Index kRows = 150;  // of a shot
constexpr int kShots = 4;

// Images l = a falling exponential whose length and level are the medium's, plus a nuisance.
struct DepartureScene {
  DenseSystem system;
  LinearModel model;

  DepartureScene() {
    const Eigen::Index n = kRows * kShots;
    system.weights.resize(n, 0);
    system.l.resize(n);
    system.std_l.resize(n);
    model.jacobian.resize(n, 2);
    system.nuisance_columns.resize(n, 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double x = static_cast<double>(i % kRows) / kRows;
      const double l = 2.0 * std::exp(-3.0 * x) + 0.2 * std::cos(static_cast<double>(i / kRows));
      system.l[i] = l;
      system.std_l[i] = 0.01 * std::sqrt(l + 0.1);
      model.jacobian(i, 0) = -2.0 * x * std::exp(-3.0 * x);
      model.jacobian(i, 1) = std::exp(-6.0 * x);
      system.nuisance_columns(i, 0) = std::sin(6.0 * x + static_cast<double>(i / kRows));
    }
    system.nuisances = {{"LED position", 0.3, true, "led1.position0"}};
    system.shot_rows.assign(kShots, kRows);
    model.predicted = system.l;
    model.scale_relative_std = 0.02;
  }

  void add_noise(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (Eigen::Index i = 0; i < system.l.size(); ++i)
      system.l[i] += system.std_l[i] * normal(random);
  }
};

TEST(ShotDepartures, FindsPowerEvenLightAndNuisance) {
  DepartureScene s;
  s.system.l.segment(kRows, kRows) *= 1.08;
  s.system.l.segment(3 * kRows, kRows).array() += 0.05;
  s.system.l += 0.02 * s.system.nuisance_columns.col(0);
  const double mean_l = s.system.l.segment(3 * kRows, kRows).mean();
  const ShotDepartures d = shot_departures(s.system, s.model);
  ASSERT_EQ(d.power_relative.size(), 4U);
  // Less the mean over the shots; a prior as wide as kWidest shrinks nothing that rows know as
  // well.
  EXPECT_NEAR(d.power_relative[1].value, 0.06, 5e-4);
  EXPECT_NEAR(d.power_relative[0].value, -0.02, 5e-4);
  EXPECT_NEAR(d.even_relative[3].value, 0.05 / mean_l, 2e-3);
  EXPECT_NEAR(d.even_relative[2].value, 0.0, 2e-3);
  EXPECT_NEAR(d.nuisances[0].value, 0.02, 1e-3);
  EXPECT_LT(d.reduced_chi2, 0.01);
}

// Unbiased, and as uncertain as it says: 200 draws of noise.
TEST(ShotDepartures, DeviationsAreThoseOfTheNoise) {
  double sum = 0.0;
  double squares = 0.0;
  double even = 0.0;
  double power_std = 0.0;
  double even_std = 0.0;
  constexpr int kSeeds = 200;
  for (int seed = 0; seed < kSeeds; ++seed) {
    DepartureScene s;
    s.add_noise(static_cast<std::uint64_t>(seed) + 1);
    const ShotDepartures d = shot_departures(s.system, s.model);
    sum += d.power_relative[2].value;
    squares += d.power_relative[2].value * d.power_relative[2].value;
    even += d.even_relative[1].value * d.even_relative[1].value;
    power_std = d.power_relative[2].std;
    even_std = d.even_relative[1].std;
    EXPECT_NEAR(d.reduced_chi2, 1.0, 0.25);  // 4.3 deviations of 600 rows
  }
  // Within 20 %: four deviations of a variance of 200 draws.
  EXPECT_NEAR(std::sqrt(squares / kSeeds) / power_std, 1.0, 0.2);
  EXPECT_NEAR(std::sqrt(even / kSeeds) / even_std, 1.0, 0.2);
  EXPECT_LT(std::abs(sum / kSeeds), 4.0 * power_std / std::sqrt(kSeeds));
}

// What all shots do alike is the scale's, also where that is free.
TEST(ShotDepartures, AFreeScaleTakesWhatIsCommon) {
  DepartureScene s;
  s.model.scale_relative_std = std::numeric_limits<double>::infinity();
  s.system.l *= 1.3;
  const ShotDepartures d = shot_departures(s.system, s.model);
  for (const Departure& p : d.power_relative) EXPECT_NEAR(p.value, 0.0, 1e-3);
}

TEST(ShotDepartures, OfOneShotThePowerIsUnknown) {
  DepartureScene s;
  const DenseSystem one = shot_of(s.system, 0);
  LinearModel model = s.model;
  model.predicted = s.model.predicted.head(kRows);
  model.jacobian = s.model.jacobian.topRows(kRows);
  const ShotDepartures d = shot_departures(one, model);
  EXPECT_TRUE(std::isinf(d.power_relative[0].std));
  model.predicted = s.model.predicted;
  EXPECT_THROW(shot_departures(one, model), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
