#include "core/fit/rig_priors.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/fit/dipole_fit.h"
#include "tests/fixtures/core/half_lit_plate.h"

namespace scattermeter {
namespace {

TEST(RigPriors, DoubtfulOnesGrowByTheirPulls) {
  RigPriors priors{
      {{"eta", 0.01, true, "eta"}, {"pose", 1.0, true, "pose0"}, {"numerics", 1e-5, false, ""}},
      {0.02}};
  EXPECT_EQ(priors.fitted().size(), 2U);
  EXPECT_FALSE(
      widen_doubtful({{"eta", "eta", 1.9, 0, 0}, {"scale", "scale", -1.5, 0, 0}}, {}, priors));
  EXPECT_EQ(priors.nuisances[0].std, 0.01);
  EXPECT_TRUE(widen_doubtful(
      {{"eta", "eta", 1.0, 0, 0}, {"pose0", "pose", -3.0, 0, 0}, {"scale", "scale", 4.0, 0, 0}}, {},
      priors));
  EXPECT_EQ(priors.nuisances[0].std, 0.01);
  EXPECT_EQ(priors.nuisances[1].std, 3.0);
  EXPECT_EQ(priors.nuisances[2].std, 1e-5);
  EXPECT_EQ(priors.scale.relative_std, 0.08);
  RigPriors exact{{}, {0.0}};
  EXPECT_FALSE(widen_doubtful({{"scale", "scale", 9.0, 0, 0}}, {}, exact));
}

// What the channels say together counts, not what one of them says.
TEST(RigPriors, JointPullsReplaceTheChannelsOwn) {
  RigPriors priors{{{"pose", 1.0, true, "pose0"}, {"pose", 1.0, true, "pose1"}}, {0.02}};
  EXPECT_TRUE(widen_doubtful({{"pose0", "pose", -3.0, 0, 0}, {"pose1", "pose", 1.0, 0, 0}},
                             {{"pose0", 1.5}, {"pose1", -2.5}}, priors));
  EXPECT_EQ(priors.nuisances[0].std, 1.0);
  EXPECT_EQ(priors.nuisances[1].std, 2.5);
}

// A plate whose light falls off across it by four deviations of what is stated: the pull finds it,
// and the estimate is nearer to the truth than its prior alone would leave it.
TEST(RigPriors, PullsFindWhatIsOff) {
  const Medium truth{1.2, 0.004, 1.3};
  const test_support::HalfLitPlate plate(1.0);
  const DistanceKnots knots = plate.knots();
  const WeightMatrix w = plate.weights(knots);
  const Eigen::VectorXd l = plate.image(Dipole(truth));
  DenseSystem system = test_support::noisy_system(w, l, 0.005, 1);
  const Eigen::VectorXd slope = Eigen::VectorXd::LinSpaced(l.size(), -1.0, 1.0);
  system.nuisance_columns = slope.cwiseProduct(l);
  system.nuisances = {{"tilt", 0.01, true, "tilt"}};
  system.l += 0.04 * system.nuisance_columns;
  DipoleFitOptions options;
  options.eta_int_over_ext = truth.eta_int_over_ext;
  const Estimate e = fit_dipole(system, knots, options).estimate;
  ASSERT_EQ(e.pulls.size(), 2U);
  EXPECT_EQ(e.pulls[0].name, "tilt");
  EXPECT_NEAR(e.pulls[0].pull, 4.0, 1.0);
  EXPECT_EQ(e.pulls[1].name, "scale");
  EXPECT_NEAR(e.sigma_s_prime_per_mm.value, 1.2, 3.0 * e.sigma_s_prime_per_mm.std + 0.0024);
}

// A scale that is off by a little shifts the coefficients by its share of what is unseen.
TEST(RigPriors, UnseenErrorsShiftTheFit) {
  const Medium truth{1.2, 0.01, 1.3};
  const test_support::HalfLitPlate plate(1.0);
  const DistanceKnots knots = plate.knots();
  const WeightMatrix w = plate.weights(knots);
  DipoleFitOptions options;
  options.eta_int_over_ext = truth.eta_int_over_ext;
  options.scale.relative_std = 0.02;
  const auto fitted = [&](double scale) {
    DenseSystem system = test_support::noisy_system(w, scale * plate.image(Dipole(truth)), 0.0, 1);
    system.std_l = 0.02 * system.l;
    return fit_dipole(system, knots, options).estimate;
  };
  const Estimate right = fitted(1.0);
  ASSERT_EQ(right.pulls.size(), 1U);
  const PriorPull& scale = right.pulls[0];
  constexpr double kOff = 0.002;
  const Estimate more = fitted(1.0 + kOff), less = fitted(1.0 - kOff);
  const double share = 2.0 * kOff / (scale.least_seen_in_std * options.scale.relative_std);
  const double s = more.sigma_s_prime_per_mm.value - less.sigma_s_prime_per_mm.value;
  const double a = more.sigma_a_per_mm.value - less.sigma_a_per_mm.value;
  EXPECT_NEAR(s, share * scale.unseen_sigma_s_prime_per_mm, 0.02 * std::abs(s));
  EXPECT_NEAR(a, share * scale.unseen_sigma_a_per_mm, 0.02 * std::abs(a));
}

// A scale stated 20 % too small, ten deviations, by an image that tells it: the optimum has moved
// to the true scale, but the pull counts from the stated one.
TEST(RigPriors, ScaleIsJudgedAboutItsStatedValue) {
  const test_support::HalfLitPlate plate(1.0);
  const DistanceKnots knots = plate.knots();
  const WeightMatrix w = plate.weights(knots);
  const DenseSystem system =
      test_support::noisy_system(w, 1.2 * plate.image(Dipole({1.2, 0.004, 1.3})), 0.0005, 1);
  const RigPriors priors{{}, {0.02}};
  const RecoveredReflectance recovered = recover_reflectance(image_information(system));
  const DipoleSolver::Point at = DipoleSolver(recovered, knots, {}, 1.3, priors.scale).best();
  EXPECT_GT(at.log_s, 0.1);
  const std::vector<PriorPull> pulls =
      judgement_of(priors, recovered, dipole_curve(knots, at.u, at.q, 1.3), at).pulls;
  ASSERT_EQ(pulls.size(), 1U);
  EXPECT_EQ(pulls[0].name, "scale");
  EXPECT_NEAR(pulls[0].pull, 10.0, 1.5);
}

}  // namespace
}  // namespace scattermeter
