#include "core/fit/prior_pulls.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// One row r = s v + noise: v = s r / (1 + s^2), its variance under the model s^2 / (1 + s^2), so
// the pull is r / sqrt(1 + s^2), and the chi-square r^2 / (1 + s^2).
TEST(PriorPulls, OneRowInClosedForm) {
  for (const double std : {0.01, 1.0, 100.0}) {
    WhitenedModel model;
    model.residual = Eigen::VectorXd::Constant(1, 3.0);
    model.free.resize(1, 0);
    model.columns = Eigen::MatrixXd::Constant(1, 1, 2.0);
    model.nuisances = {{"group", std, true, "name"}};
    model.data_length = 10.0;
    const double s = 2.0 * std;
    const ModelJudgement j = judge(model);
    EXPECT_NEAR(j.chi2, 9.0 / (1.0 + s * s), 1e-12);
    EXPECT_EQ(j.dof, 1.0);
    ASSERT_EQ(j.pulls.size(), 1U);
    EXPECT_NEAR(j.pulls[0].pull, 3.0 / std::sqrt(1.0 + s * s), 1e-9);
    EXPECT_NEAR(j.pulls[0].offset, std * 3.0 * s / (1.0 + s * s), 1e-12);
    EXPECT_NEAR(j.pulls[0].image_relative, std::abs(j.pulls[0].offset) * 2.0 / 10.0, 1e-12);
  }
}

// For a quantity stated as exact: the score statistic, and the least-squares offset.
TEST(PriorPulls, ExactQuantitiesGetAScoreTest) {
  WhitenedModel model;
  model.residual = Eigen::Vector3d(1.0, 2.0, 4.0);
  model.free.resize(3, 1);
  model.free << 1.0, 1.0, 1.0;
  model.columns.resize(3, 1);
  model.columns << -1.0, 0.0, 1.0;
  model.nuisances = {{"eta", 0.0, false, "eta"}};
  model.data_length = 1.0;
  const ModelJudgement j = judge(model);
  ASSERT_EQ(j.pulls.size(), 1U);
  EXPECT_NEAR(j.pulls[0].offset, 3.0 / 2.0, 1e-12);
  EXPECT_NEAR(std::abs(j.pulls[0].pull), 3.0 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(j.dof, 2.0);
}

TEST(PriorPulls, WhatTheUnknownsImitateHasNone) {
  WhitenedModel model;
  model.residual = Eigen::Vector3d(1.0, 2.0, 4.0);
  model.free.resize(3, 1);
  model.free << 1.0, 2.0, 3.0;
  model.columns.resize(3, 2);
  model.columns.col(0) = 2.0 * model.free;
  model.columns.col(1) = -0.5 * model.free;
  model.nuisances = {{"scale", 0.1, true, "scale"}, {"eta", 0.0, false, "eta"}};
  model.data_length = 1.0;
  const ModelJudgement j = judge(model);
  ASSERT_EQ(j.pulls.size(), 2U);
  EXPECT_EQ(j.pulls[0].pull, 0.0);
  EXPECT_EQ(j.pulls[1].pull, 0.0);
}

// A free nuisance is an unknown; one that is not fitted varies but has no pull.
TEST(PriorPulls, FreeAndHeldOnesHaveNone) {
  WhitenedModel model;
  model.residual = Eigen::Vector3d(1.0, 2.0, 4.0);
  model.free.resize(3, 0);
  model.columns = Eigen::Matrix3d::Identity();
  model.nuisances = {{"ambient", std::numeric_limits<double>::infinity(), true, "ambient"},
                     {"eta", 1.0, true, "eta"},
                     {"numerics", 2.0, false, ""}};
  model.data_length = 1.0;
  const ModelJudgement j = judge(model);
  EXPECT_EQ(j.dof, 2.0);
  EXPECT_NEAR(j.chi2, 4.0 / 2.0 + 16.0 / 5.0, 1e-12);
  ASSERT_EQ(j.pulls.size(), 1U);
  EXPECT_EQ(j.pulls[0].name, "eta");
  EXPECT_NEAR(j.pulls[0].pull, 2.0 / std::sqrt(2.0), 1e-12);
}

// The image of a quantity that is off by as much as just shows has a pull of kMostPull, and shifts
// the least-squares solution of rows and priors together by what is stated.
TEST(PriorPulls, LeastErrorThatShowsAndItsShift) {
  constexpr Eigen::Index kRows = 12, kNuisances = 3;
  std::srand(3);
  WhitenedModel model;
  model.free = Eigen::MatrixXd::Random(kRows, 2);
  model.columns = Eigen::MatrixXd::Random(kRows, kNuisances);
  model.columns.col(1) = 2.0 * model.free.col(0) - model.free.col(1) + 0.03 * model.columns.col(1);
  model.nuisances = {{"a", 0.5, true, "a"}, {"b", 2.0, true, "b"}, {"c", 40.0, true, "c"}};
  model.data_length = 1.0;
  model.residual = Eigen::VectorXd::Zero(kRows);
  const std::vector<PriorPull> stated = judge(model).pulls;
  ASSERT_EQ(stated.size(), 3U);
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    SCOPED_TRACE(stated[i].name);
    model.residual = model.columns.col(at) * stated[i].least_seen_in_std * model.nuisances[i].std;
    EXPECT_NEAR(judge(model).pulls[i].pull, kMostPull, 1e-9);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(kRows + kNuisances, 2 + kNuisances);
    all.topRows(kRows) << model.free, model.columns;
    for (Eigen::Index k = 0; k < kNuisances; ++k) {
      all(kRows + k, 2 + k) = 1.0 / model.nuisances[static_cast<std::size_t>(k)].std;
    }
    Eigen::VectorXd data = Eigen::VectorXd::Zero(kRows + kNuisances);
    data.head(kRows) = model.residual;
    const Eigen::VectorXd solved = (all.transpose() * all).ldlt().solve(all.transpose() * data);
    EXPECT_NEAR(stated[i].unseen_sigma_s_prime_per_mm, solved[0], 1e-9 * std::abs(solved[0]));
    EXPECT_NEAR(stated[i].unseen_sigma_a_per_mm, solved[1], 1e-9 * std::abs(solved[1]));
  }
  // Nearly a change by the unknowns, b shows last and shifts them most.
  EXPECT_GT(stated[1].least_seen_in_std, 3.0 * stated[0].least_seen_in_std);
  EXPECT_GT(stated[1].unseen_sigma_s_prime_per_mm, 100.0);
}

// What the image does not show at all has a limit, too; what is exact has none.
TEST(PriorPulls, LeastErrorThatShowsIsFinite) {
  WhitenedModel model;
  model.residual = Eigen::Vector3d(1.0, 2.0, 4.0);
  model.free = Eigen::MatrixXd::Identity(3, 2);
  model.columns = Eigen::MatrixXd::Zero(3, 3);
  model.columns.col(1) = model.free.col(0);
  model.columns.col(2) = Eigen::Vector3d::Ones();
  model.nuisances = {
      {"none", 1.0, true, "none"}, {"scale", 0.5, true, "scale"}, {"eta", 0.0, true, "eta"}};
  model.data_length = 1.0;
  const std::vector<PriorPull> pulls = judge(model).pulls;
  EXPECT_NEAR(pulls[0].least_seen_in_std, 4e6, 1.0);
  EXPECT_EQ(pulls[0].unseen_sigma_s_prime_per_mm, 0.0);
  EXPECT_NEAR(pulls[1].least_seen_in_std, 4e6, 1.0);
  EXPECT_NEAR(pulls[1].unseen_sigma_s_prime_per_mm, 2e6, 1.0);
  EXPECT_EQ(pulls[2].least_seen_in_std, 0.0);
}

Estimate resting_on(std::vector<PriorPull> pulls) {
  Estimate e;
  e.sigma_s_prime_per_mm = normal_quantity(2.0, 0.01);
  e.sigma_a_per_mm = normal_quantity(0.1, 0.001);
  e.pulls = std::move(pulls);
  return e;
}

PriorPull unseen(const char* name, const char* group, double s, double a) {
  PriorPull p{name, group};
  p.least_seen_in_std = 20.0;
  p.unseen_sigma_s_prime_per_mm = s;
  p.unseen_sigma_a_per_mm = a;
  return p;
}

// Of each group the worst, by either coefficient.
TEST(PriorPulls, WhatAnEstimateRestsOn) {
  const Estimate e = resting_on(
      {unseen("eta", "eta", 0.05, 0.0), unseen("led1.power", "LED power", -0.07, 0.0),
       unseen("led2.power", "LED power", 0.0, -0.012), unseen("scale", "scale", -0.08, 0.0)});
  const std::vector<PriorPull> on = rests_on(e);
  ASSERT_EQ(on.size(), 2U);
  EXPECT_EQ(on[0].name, "led2.power");
  EXPECT_EQ(on[1].name, "scale");
  EXPECT_NEAR(unseen_in_std(on[0], e), 12.0, 1e-9);
  EXPECT_EQ(rests_on_sentence(e),
            "rests on the stated LED power, scale: an error of LED power (led2.power) of up to 20 "
            "stated deviations would not show, and would shift sigma_s' by 0 and sigma_a by 0.012 "
            "/mm");
  EXPECT_EQ(rests_on_sentence(resting_on({unseen("eta", "eta", 0.05, 0.0)})), "");
}

// Other images that see more of it leave less unseen; those that see less change nothing.
TEST(PriorPulls, OtherImagesSeeAsWell) {
  PriorPull p = unseen("pose0", "pose", -0.08, 0.002);
  see_from(40.0, p);
  EXPECT_EQ(p.least_seen_in_std, 20.0);
  see_from(5.0, p);
  EXPECT_EQ(p.least_seen_in_std, 5.0);
  EXPECT_NEAR(p.unseen_sigma_s_prime_per_mm, -0.02, 1e-12);
  EXPECT_NEAR(p.unseen_sigma_a_per_mm, 0.0005, 1e-12);
}

// Moves are relative for sigma_s', absolute for sigma_a, and of one deviation.
TEST(PriorPulls, UnseenByMoves) {
  PriorPull p = unseen("eta", "eta", -0.08, 0.002);
  set_unseen(Eigen::Vector3d(0.1, 0.001, 7.0), 1.5, p);
  EXPECT_NEAR(p.unseen_sigma_s_prime_per_mm, 0.15 * p.least_seen_in_std, 1e-12);
  EXPECT_NEAR(p.unseen_sigma_a_per_mm, 0.001 * p.least_seen_in_std, 1e-12);
}

// Where all statements hold, pulls are standard normal and the chi-square has its degrees of
// freedom, for nuisances that the image determines and for those that it hardly sees.
TEST(PriorPulls, AreStandardNormal) {
  constexpr int kRows = 30, kDraws = 2000;
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto drawn = [&](Eigen::Index rows, Eigen::Index cols) {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); }));
  };
  WhitenedModel model;
  model.free = drawn(kRows, 3);
  model.columns = drawn(kRows, 4);
  model.columns.col(1) *= 1e-3;
  model.columns.col(2) *= 1e3;
  model.nuisances = {
      {"a", 1.0, true, "a"}, {"b", 2.0, true, "b"}, {"c", 3.0, true, "c"}, {"d", 0.0, false, "d"}};
  model.data_length = 1.0;
  Eigen::Vector4d squares = Eigen::Vector4d::Zero();
  double chi2 = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    model.residual = model.free * drawn(3, 1) + drawn(kRows, 1);
    for (Eigen::Index k = 0; k < 3; ++k) {
      model.residual += static_cast<double>(k + 1) * normal(random) * model.columns.col(k);
    }
    const ModelJudgement j = judge(model);
    ASSERT_EQ(j.pulls.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
      squares[static_cast<Eigen::Index>(k)] += j.pulls[k].pull * j.pulls[k].pull / kDraws;
    }
    chi2 += j.chi2 / kDraws;
  }
  // Four deviations of a mean of so many squares.
  const double limit = 4.0 * std::sqrt(2.0 / kDraws);
  for (Eigen::Index k = 0; k < 4; ++k) EXPECT_NEAR(squares[k], 1.0, limit) << k;
  EXPECT_NEAR(chi2, 27.0, 4.0 * std::sqrt(2.0 * 27.0 / kDraws));
}

TEST(PriorPulls, ContradictionIsSignificantAndVisible) {
  const std::vector<PriorPull> pulls = {{"pose0", "pose", 9.0, 1.0, 1e-5},
                                        {"led1.position0", "LED position", -7.0, 1.0, 0.02},
                                        {"eta", "eta", 6.0, 0.1, 0.01},
                                        {"scale", "scale", 4.0, 0.1, 0.5}};
  const PriorPull* worst = contradiction(pulls, 5.0, 1e-3);
  ASSERT_NE(worst, nullptr);
  EXPECT_EQ(worst->group, "LED position");
  const std::string text = contradiction_sentence(*worst, pulls);
  EXPECT_THAT(text, HasSubstr("LED position (led1.position0)"));
  EXPECT_THAT(text, HasSubstr("7 standard deviations: measure the LED's position"));
  // eta comes near, the pose changes nothing that is visible, and the scale is far behind.
  EXPECT_THAT(text, HasSubstr("; or perhaps the eta, by 6"));
  EXPECT_THAT(text, Not(HasSubstr("pose")));
  EXPECT_THAT(text, Not(HasSubstr("scale")));
  EXPECT_EQ(contradiction(pulls, 10.0, 1e-3), nullptr);
}

// What changes nothing that is visible counts only where it is clear, and after what does.
TEST(PriorPulls, AClearContradictionNeedNotBeVisible) {
  const auto of_pose = [](double pull) {
    return std::vector<PriorPull>{{"pose0", "pose", pull, 1.0, 1e-5}};
  };
  EXPECT_EQ(contradiction(of_pose(4.4), 4.0, 1e-3), nullptr);
  const std::vector<PriorPull> clear = of_pose(-4.6);
  ASSERT_EQ(contradiction(clear, 4.0, 1e-3), &clear.front());
  EXPECT_EQ(contradiction(clear, 6.0, 1e-3), nullptr);
}

// In a frame whose noise is small, what explains little may yet be far from what the rig states.
TEST(PriorPulls, AFarContradictionNeedNotExplainMuch) {
  const auto of_lens = [](double pull, double image_relative) {
    return std::vector<PriorPull>{{"lens1", "lens", pull, 1.0, image_relative, 6e-5}};
  };
  EXPECT_EQ(contradiction(of_lens(4.9, 7e-3), 4.0, 1e-3), nullptr);
  EXPECT_EQ(contradiction(of_lens(9.4, 5e-4), 4.0, 1e-3), nullptr);
  const std::vector<PriorPull> far = of_lens(-5.1, 7e-3);
  EXPECT_EQ(contradiction(far, 4.0, 1e-3), &far.front());
}

TEST(PriorPulls, EtaFartherThanTablesAreOff) {
  std::vector<PriorPull> pulls(2);
  pulls[0].group = "scale";
  pulls[0].offset = 0.3;
  pulls[1].group = "eta";
  pulls[1].least_seen_in_std = 1.0;
  pulls[1].offset = -0.115;
  EXPECT_EQ(far_eta(pulls, 1.49), "");
  pulls[1].offset = -0.125;
  EXPECT_THAT(far_eta(pulls, 1.49),
              ::testing::HasSubstr("the shots put eta at 1.36, which differs from the 1.49 that"));
  pulls[1].offset = 0.13;
  EXPECT_THAT(far_eta(pulls, 1.49), ::testing::HasSubstr("eta at 1.62"));
}

// Its offset is not held by a prior: noise alone may make it large.
TEST(PriorPulls, AnExactEtaIsFarOnlyIfTheImageTellsIt) {
  std::vector<PriorPull> pulls(1);
  pulls[0].group = "eta";
  pulls[0].offset = 0.2;
  pulls[0].pull = 0.8;
  EXPECT_EQ(far_eta(pulls, 1.49), "");
  pulls[0].pull = 2.2;
  EXPECT_NE(far_eta(pulls, 1.49), "");
  pulls[0].pull = 0.8;
  pulls[0].least_seen_in_std = 1.0;  // with a prior
  EXPECT_NE(far_eta(pulls, 1.49), "");
}

}  // namespace
}  // namespace scattermeter
