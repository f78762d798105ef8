#include "core/fit/profile_interval.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "core/diffusion/dipole_curve.h"
#include "core/fit/fit_uncertainty.h"
#include "tests/fixtures/core/plate_system.h"

namespace scattermeter {
namespace {

using Coefficient = DipoleSolver::Coefficient;
using test_support::kEta;
using test_support::noisy_system;
using test_support::plate;

constexpr double kRise95 = 3.841;

struct Profiled {
  double sigma_s, sigma_a, std_s, std_a;
  Interval s, a;
};

Profiled profiled(const Eigen::VectorXd& l, double noise, unsigned seed, double scale_std) {
  const DenseSystem system = noisy_system(plate().w, l, noise, seed);
  const RecoveredReflectance recovered = recover_reflectance(system);
  const std::vector<Nuisance> none;
  const ScalePrior scale{scale_std};
  const DipoleSolver solver(recovered, plate().knots, none, kEta, scale);
  const DipoleSolver::Point p = solver.best();
  EXPECT_TRUE(p.converged);
  const Eigen::Matrix2d covariance =
      FitUncertainty(recovered, none, dipole_curve(plate().knots, p.u, p.q, kEta), p.u, p.q,
                     std::exp(p.log_s), scale, 1.0)
          .covariance_of_fitted();
  Profiled out{p.sigma_s_prime_per_mm(),
               p.sigma_a_per_mm(),
               std::sqrt(covariance(0, 0)),
               std::sqrt(covariance(1, 1)),
               {},
               {}};
  out.s = profile_interval(solver, p, Coefficient::kSigmaSPrime, out.std_s, kRise95);
  out.a = profile_interval(solver, p, Coefficient::kSigmaA, out.std_a, kRise95);
  return out;
}

// Little noise: the chi-square is a parabola, and the profile knows what the Jacobian knows.
TEST(ProfileInterval, IsTheNormalOneOnAParabola) {
  for (double scale_std : {0.0, 0.02, std::numeric_limits<double>::infinity()}) {
    const Profiled p = profiled(plate().image({1.2, 0.02, kEta}), 1e-4, 3, scale_std);
    ASSERT_LT(p.std_a, 0.02 * p.sigma_a);
    EXPECT_NEAR((p.s.high - p.sigma_s) / p.std_s, 1.96, 0.04);
    EXPECT_NEAR((p.sigma_s - p.s.low) / p.std_s, 1.96, 0.04);
    EXPECT_NEAR((p.a.high - p.sigma_a) / p.std_a, 1.96, 0.04);
    EXPECT_NEAR((p.sigma_a - p.a.low) / p.std_a, 1.96, 0.04);
  }
}

// In deviations of the free estimate, z of it is N(t, 1) with t the truth's. The interval holds the
// truth where z < t + 1.96 and, z < 0 being the bound, (t - z)^2 - z^2 < 3.84: 97.5 % for t = 0,
// 96.7 % for t = 1. A share of 200 seeds is known to 1.2 %; four of that.
class SmallAbsorption : public ::testing::TestWithParam<double> {};

TEST_P(SmallAbsorption, IsHeldAsOftenAsStated) {
  // The deviation beside no absorption, which the truth counts in.
  const double std_a = profiled(plate().image({1.2, 0.0, kEta}), 1e-6, 1, 0.0).std_a * 0.02 / 1e-6;
  const double truth = GetParam() * std_a;
  const Eigen::VectorXd l = plate().image({1.2, truth, kEta});
  constexpr int kSeeds = 200;
  int held_a = 0, held_s = 0, at_zero = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Profiled p = profiled(l, 0.02, seed, 0.0);
    EXPECT_GE(p.a.low, 0.0);
    EXPECT_LE(p.a.low, p.sigma_a);
    EXPECT_GT(p.a.high, p.sigma_a);
    EXPECT_TRUE(std::isfinite(p.a.high));
    EXPECT_LT(p.s.low, p.sigma_s);
    EXPECT_GT(p.s.high, p.sigma_s);
    held_a += p.a.low <= truth && truth <= p.a.high ? 1 : 0;
    held_s += p.s.low <= 1.2 && 1.2 <= p.s.high ? 1 : 0;
    at_zero += p.a.low == 0.0 ? 1 : 0;
  }
  std::printf("sigma_a = %.2g (%g deviations): held %d, sigma_s' held %d, from zero %d of %d\n",
              truth, GetParam(), held_a, held_s, at_zero, kSeeds);
  const double expected = GetParam() == 0.0 ? 0.975 : 0.967;
  EXPECT_NEAR(static_cast<double>(held_a) / kSeeds, expected, 0.048);
  EXPECT_LT(held_a, kSeeds);
  // The bound can only help sigma_s' (correlated with sigma_a): at least 95 %, four deviations off.
  EXPECT_GE(static_cast<double>(held_s) / kSeeds, 0.95 - 0.062);
  EXPECT_GT(at_zero, kSeeds / 2);
}

INSTANTIATE_TEST_SUITE_P(Truths, SmallAbsorption, ::testing::Values(0.0, 1.0));

// Its ends are where the chi-square has risen by the asked amount.
TEST(ProfileInterval, EndsWhereTheChiSquareHasRisen) {
  const DenseSystem system = noisy_system(plate().w, plate().image({1.2, 0.004, kEta}), 0.1, 5);
  const RecoveredReflectance recovered = recover_reflectance(system);
  const std::vector<Nuisance> none;
  const DipoleSolver solver(recovered, plate().knots, none, kEta, {0.02});
  const DipoleSolver::Point p = solver.best();
  for (double rise : {1.0, kRise95, 9.0}) {
    const Interval i = profile_interval(solver, p, Coefficient::kSigmaSPrime, 0.02, rise);
    for (double end : {i.low, i.high}) {
      const auto there = solver.best_with(Coefficient::kSigmaSPrime, end, p);
      ASSERT_TRUE(there.has_value());
      EXPECT_NEAR((there->cost - p.cost) / rise, 1.0, 0.05);
    }
  }
}

}  // namespace
}  // namespace scattermeter
