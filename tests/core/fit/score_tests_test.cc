#include "core/fit/score_tests.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "tests/fixtures/core/lit_plate.h"
#include "tests/fixtures/core/noisy_system.h"

namespace scattermeter {
namespace {

using test_support::LitPlate;
using test_support::noisy_system;

const Medium kTestedMedium{1.2, 0.004, 1.3};

struct TestedPlate {
  LitPlate plate{1.0, {0, 15, -15, 15}};
  DistanceKnots knots = plate.knots();
  WeightMatrix w = plate.weights(knots);
  Eigen::VectorXd l = plate.image(kTestedMedium);
};

const TestedPlate& tested_plate() {
  static const TestedPlate p;
  return p;
}

ScoreTests tests_of(const DenseSystem& system, double scale_std, double eta = 1.3) {
  DipoleFitOptions options;
  options.eta_int_over_ext = eta;
  options.scale.relative_std = scale_std;
  const DipoleFit fit = fit_dipole(system, tested_plate().knots, options);
  return score_tests(recover_reflectance(system), system.nuisances, tested_plate().knots,
                     fit.optimum, eta, options.scale, 1.0);
}

// Where all is as stated p-values are even: a mean of 200 is known to 0.020, a share of 5 % to
// 1.5 %; four of each.
TEST(ScoreTests, FalseAlarmsAreAsStated) {
  for (double scale_std : {0.0, 0.02}) {
    double scale_mean = 0.0, eta_mean = 0.0;
    int scale_low = 0, eta_low = 0;
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (unsigned seed = 1; seed <= 200; ++seed) {
      const double scale = std::exp(scale_std * normal(random));
      const ScoreTests d =
          tests_of(noisy_system(tested_plate().w, scale * tested_plate().l, 0.01, seed), scale_std);
      scale_mean += d.scale.p_value / 200.0;
      eta_mean += d.eta.p_value / 200.0;
      scale_low += d.scale.p_value < 0.05 ? 1 : 0;
      eta_low += d.eta.p_value < 0.05 ? 1 : 0;
    }
    std::printf("scale: mean %.3f, %d below 0.05; eta: mean %.3f, %d\n", scale_mean, scale_low,
                eta_mean, eta_low);
    EXPECT_NEAR(scale_mean, 0.5, 0.082);
    EXPECT_NEAR(eta_mean, 0.5, 0.082);
    EXPECT_NEAR(scale_low, 10, 12.4);
    EXPECT_NEAR(eta_low, 10, 12.4);
  }
}

TEST(ScoreTests, MeasuresWhatIsOff) {
  const ScoreTests scale =
      tests_of(noisy_system(tested_plate().w, 1.03 * tested_plate().l, 0.002, 1), 0.0);
  EXPECT_LT(scale.scale.p_value, 1e-6);
  EXPECT_NEAR(scale.scale.offset, std::log(1.03), 0.006);
  EXPECT_NEAR(scale.scale.image_relative, std::abs(scale.scale.offset), 1e-3);
  const ScoreTests eta =
      tests_of(noisy_system(tested_plate().w, tested_plate().l, 0.002, 1), 0.0, 1.27);
  EXPECT_LT(eta.eta.p_value, 1e-6);
  EXPECT_NEAR(eta.eta.offset, 0.03, 0.006);
  // 3 % are nothing where the prior allows 5 %, and a free scale cannot be off.
  EXPECT_GT(tests_of(noisy_system(tested_plate().w, 1.03 * tested_plate().l, 0.002, 1), 0.05)
                .scale.p_value,
            0.1);
  EXPECT_EQ(tests_of(noisy_system(tested_plate().w, 1.03 * tested_plate().l, 0.002, 1),
                     std::numeric_limits<double>::infinity())
                .scale.p_value,
            1.0);
}

TEST(ScoreTests, AreToldWithOffsetsThatMayBe) {
  ScoreTest test;
  test.offset = -0.0544;
  EXPECT_EQ(contradiction_sentence(test, "eta"),
            "the shots contradict the eta that the rig states: the best fit differs from it by "
            "-0.0544");
  test.offset = 1.1e3;
  EXPECT_EQ(contradiction_sentence(test, "scale"),
            "the shots contradict the scale that the rig states, and no other value explains them");
}

// A declared error of the method that looks like the scale is no evidence against the scale.
TEST(ScoreTests, ForgivesWhatANuisanceExplains) {
  DenseSystem system = noisy_system(tested_plate().w, 1.03 * tested_plate().l, 0.002, 1);
  system.nuisances = {{"method", 0.03, false}};
  system.nuisance_columns = tested_plate().l;
  EXPECT_GT(tests_of(system, 0.0).scale.p_value, 0.05);
}

}  // namespace
}  // namespace scattermeter
