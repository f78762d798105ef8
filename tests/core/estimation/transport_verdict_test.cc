#include "core/estimation/transport_verdict.h"

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// A step of two unknowns: variances of noise and of paths, both the same for each unknown.
ScatteringEquation::Step made_step(double move, double noise, double paths) {
  ScatteringEquation::Step step;
  step.to = {2.0, 0.01, 1.0};
  step.size = Eigen::Vector2d::Ones();
  step.move = step.taken = Eigen::Vector2d(move, 0.0);
  step.causes = {{"noise", noise * Eigen::Matrix2d::Identity()},
                 {"Monte Carlo", paths * Eigen::Matrix2d::Identity()}};
  step.covariance = (noise + paths) * Eigen::Matrix2d::Identity();
  return step;
}

TEST(TransportVerdict, StepsAreCloseWhereTheirSquaresAreSmall) {
  // Half the square of 0.1 is 0.005: 0.15 of a deviation of 1/30.
  EXPECT_TRUE(is_close(made_step(0.1, 0.034 * 0.034, 0.0), 8, {}));
  EXPECT_FALSE(is_close(made_step(0.1, 0.033 * 0.033, 0.0), 8, {}));
  // Of less than 2 % whatever the deviation.
  EXPECT_TRUE(is_close(made_step(-0.0199, 1e-12, 0.0), 8, {}));
  EXPECT_FALSE(is_close(made_step(-0.0201, 1e-12, 0.0), 8, {}));
  // Once many paths are spent, up to 1.7 times as long.
  EXPECT_TRUE(is_close(made_step(0.0339, 1e-12, 0.0), 65, {}));
  EXPECT_FALSE(is_close(made_step(0.0339, 1e-12, 0.0), 64, {}));
  // Where the image is not explained there, whatever the deviation, only of less than 5 %.
  const LackOfFit missed{30.0, 14.0, 0.0076, 0.01};
  EXPECT_FALSE(is_close(made_step(0.051, 1.0, 0.0), 64, missed));
  EXPECT_TRUE(is_close(made_step(0.049, 1.0, 0.0), 64, missed));
  // Of more than a quarter, none.
  EXPECT_TRUE(is_close(made_step(0.249, 1.0, 0.0), 8, {}));
  EXPECT_FALSE(is_close(made_step(0.251, 1.0, 0.0), 8, {}));
}

// A step within two deviations of its own is noise, whatever their causes.
TEST(TransportVerdict, StepsWithinTheirErrorAreNoise) {
  ScatteringEquation::Step step = made_step(0.3, 0.01, 0.0144);
  step.change = 0.311;
  EXPECT_TRUE(is_noise(step));
  step.change = 0.313;
  EXPECT_FALSE(is_noise(step));
  // By the effect on the image.
  step.size[1] = 2.0;
  EXPECT_TRUE(is_noise(step));
}

// Scatter that is no error of paths grows in their terms as they become more.
TEST(TransportVerdict, WeightsFitScatterThatGrowsWithThePaths) {
  const PathErrors assumed{2.0, 100};
  EXPECT_DOUBLE_EQ(assumed.of_block(), 1.0 / 512.0 + 0.01);
  EXPECT_TRUE(fits_weights({4.0, 300}, assumed));
  EXPECT_FALSE(fits_weights({3.0, 100}, assumed));
  EXPECT_FALSE(fits_weights({2.0, 100}, {1.0, 8}));
  // Where fewer paths are to be had, their errors are those of these.
  EXPECT_DOUBLE_EQ((PathErrors{2.0, 100, 128}.of_block()), 1.0 / 128.0 + 0.01);
  EXPECT_FALSE(fits_weights({1.0, 128, 128}, {1.0, 8, 512}));
}

// Whatever the first look has, the shots are expected to add what the paths will at the end.
TEST(TransportVerdict, FirstWeightsAreForTwiceTheFinalPaths) {
  EXPECT_DOUBLE_EQ(first_errors(8, 512).of_block(), 2.0 / 512.0);
  EXPECT_DOUBLE_EQ(first_errors(200, 200).of_block(), 2.0 / 200.0);
}

// Deviations of paths that further blocks will remove do not excuse a long step.
TEST(TransportVerdict, ClosenessCountsOnTheFinalPaths) {
  EXPECT_FALSE(is_close(made_step(0.1, 0.03 * 0.03, 0.03 * 0.03), 8, {}));
  EXPECT_TRUE(is_close(made_step(0.1, 0.03 * 0.03, 0.03 * 0.03), 512, {}));
}

TEST(TransportVerdict, PathsArePreciseAgainstTheRestOrInThemselves) {
  EXPECT_TRUE(is_precise(made_step(0.0, 1e-2, 0.9e-3), 0.01, 64));
  EXPECT_FALSE(is_precise(made_step(0.0, 1e-2, 1.1e-3), 0.01, 64));
  EXPECT_FALSE(is_precise(made_step(0.0, 1e-2, 0.9e-3), 0.01, 63));
  // 1e-3 of sigma_s', 5e-3 of sigma_a (0.4 per mm here).
  EXPECT_TRUE(is_precise(made_step(0.0, 0.0, 0.99e-6), 0.4, 64));
  EXPECT_FALSE(is_precise(made_step(0.0, 0.0, 1.01e-6), 0.4, 64));
  EXPECT_FALSE(is_precise(made_step(0.0, 0.0, 0.99e-6), 0.1, 64));
}

// Pulls above three, or a misfit of one in a hundred; what is refused is beyond doubt.
TEST(TransportVerdict, DoubtLiesBetweenNothingAndARefusal) {
  const auto pull = [](double size) {
    return std::vector<PriorPull>{{"eta", "eta", size, 0.04, 0.01, 0.01, 0.01}};
  };
  EXPECT_FALSE(is_in_doubt({}, pull(-2.9)));
  EXPECT_TRUE(is_in_doubt({}, pull(-3.1)));
  EXPECT_TRUE(is_in_doubt({}, pull(3.9)));
  EXPECT_FALSE(is_in_doubt({}, pull(4.1)));
  LackOfFit misfit;
  misfit.rms = 0.01;
  for (const auto& [p_value, doubted] : {std::pair{0.02, false}, {0.009, true}, {1e-7, false}}) {
    misfit.p_value = p_value;
    EXPECT_EQ(is_in_doubt(misfit, {}), doubted) << p_value;
  }
}

TEST(TransportVerdict, ReportHoldsValuesDeviationsAndBudget) {
  ScatteringEquation::Step step = made_step(0.0, 0.0, 0.0);
  step.covariance << 4e-4, 1e-5, 1e-5, 1e-6;
  step.causes = {{"noise", (Eigen::Matrix2d() << 1e-4, 0, 0, 0.25e-6).finished()}};
  Estimate estimate;
  estimate.budget = {{"old", 1.0, 1.0}};
  report_step(step, estimate);
  EXPECT_TRUE(estimate.converged);
  EXPECT_EQ(estimate.sigma_s_prime_per_mm.value, 2.0);
  EXPECT_NEAR(estimate.sigma_s_prime_per_mm.std, 0.04, 1e-12);
  EXPECT_EQ(estimate.sigma_a_per_mm.value, 0.01);
  EXPECT_NEAR(estimate.sigma_a_per_mm.std, 0.001, 1e-12);
  EXPECT_NEAR(estimate.correlation, 0.5, 1e-12);
  ASSERT_EQ(estimate.budget.size(), 1U);
  EXPECT_EQ(estimate.budget[0].cause, "noise");
  EXPECT_NEAR(estimate.budget[0].std_sigma_s_prime_per_mm, 0.02, 1e-12);
  EXPECT_NEAR(estimate.budget[0].std_sigma_a_per_mm, 0.0005, 1e-12);
  EXPECT_EQ(estimate.scale.value, 1.0);
  EXPECT_EQ(estimate.scale.std, 0.0);
}

Estimate trusted() {
  Estimate estimate;
  estimate.sigma_s_prime_per_mm = normal_quantity(2.0, 0.1);
  estimate.sigma_a_per_mm = normal_quantity(0.01, 0.001);
  return estimate;
}

TEST(TransportVerdict, NothingIsAddedToATrustedEstimate) {
  Estimate estimate = trusted();
  LackOfFit misfit;
  misfit.rms = 0.1;
  misfit.p_value = 1e-3;  // large, but not significant
  add_refusals(misfit, 0.01, {}, {0.5, 0.2, 0.02}, kLeastBlocks, estimate);
  EXPECT_TRUE(estimate.reasons.empty());
  EXPECT_EQ(estimate.misfit_relative, 0.1);
  EXPECT_EQ(estimate.misfit_p_value, 1e-3);
}

TEST(TransportVerdict, EachReasonIsStated) {
  LackOfFit misfit;
  misfit.rms = 0.04;
  misfit.p_value = 1e-9;
  Estimate estimate = trusted();
  add_refusals(misfit, 0.0, {}, {std::log(1.05), 0.01, 1e-7}, 2, estimate);
  ASSERT_EQ(estimate.reasons.size(), 3U);
  EXPECT_EQ(estimate.reasons[0],
            "the time was too short: 2 blocks of paths for each light, at least 64 are needed");
  EXPECT_EQ(estimate.reasons[1],
            "transport does not explain the shots: parts of the image are 4 % off (scale, light, "
            "pose, shape or eta are not as the rig states)");
  EXPECT_EQ(estimate.reasons[2],
            "the shots contradict the scale that the rig states: it should be at least 5 +- 1 % "
            "larger (or light, pose, shape or eta are not as the rig states)");
}

TEST(TransportVerdict, UnexplainedResidualsAndContradictionsAreReasons) {
  Estimate estimate = trusted();
  estimate.rms_relative = 0.07;
  add_refusals({}, 0.06,
               {{"eta", "eta", 4.0, 0.04, 0.01}, {"led1.position0", "LED position", -9.0, 2, 0.1}},
               {}, kLeastBlocks, estimate);
  ASSERT_EQ(estimate.reasons.size(), 2U);
  // What is named comes first.
  EXPECT_NE(estimate.reasons[0].find("LED position (led1.position0)"), std::string::npos);
  EXPECT_EQ(estimate.reasons[1],
            "transport does not explain the shots: the residual is 7 %, and noise and Monte Carlo "
            "errors leave 6 % unexplained");
  EXPECT_EQ(estimate.pulls.size(), 2U);
}

TEST(TransportVerdict, LightThatDiesOffWithinAPatchIsNotResolved) {
  const std::vector<double> area_mm2 = {0.16, 0.25, 0.25};  // patches of 0.5 mm
  const auto reasons = [&](double sigma_s_prime, double sigma_a) {
    Estimate estimate = trusted();
    estimate.sigma_s_prime_per_mm = normal_quantity(sigma_s_prime, 0.1);
    estimate.sigma_a_per_mm = normal_quantity(sigma_a, 0.1);
    refuse_unresolved(area_mm2, estimate);
    return estimate.reasons.size();
  };
  EXPECT_EQ(reasons(12.0, 0.002), 0U);
  EXPECT_EQ(reasons(8.0, 4.0), 0U);   // 0.083 mm
  EXPECT_EQ(reasons(3.5, 15.0), 1U);  // 0.035 mm
  EXPECT_EQ(reasons(3.0, 0.0), 0U);
}

TEST(TransportVerdict, NoisyPathsJudgeNothing) {
  Estimate estimate = trusted();
  refuse_noisy(0.25, estimate);
  EXPECT_TRUE(estimate.reasons.empty());
  refuse_noisy(2.9, estimate);
  ASSERT_EQ(estimate.reasons.size(), 1U);
  EXPECT_NE(estimate.reasons[0].find("the residual is 290 %"), std::string::npos);
}

TEST(TransportVerdict, SmallOrInsignificantScalesAreNoReason) {
  Estimate estimate = trusted();
  add_refusals({}, 0.0, {}, {0.009, 0.001, 1e-12}, kLeastBlocks, estimate);
  add_refusals({}, 0.0, {}, {0.05, 0.02, 1e-4}, kLeastBlocks, estimate);
  EXPECT_TRUE(estimate.reasons.empty());
  add_refusals({}, 0.0, {}, {-0.05, 0.001, 1e-12}, kLeastBlocks, estimate);
  ASSERT_EQ(estimate.reasons.size(), 1U);
  EXPECT_NE(estimate.reasons[0].find("at least 4.9 +- 0.1 % smaller"), std::string::npos);
}

}  // namespace
}  // namespace scattermeter
