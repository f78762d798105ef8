#include "core/fit/prior_pulls.h"

#include <cmath>
#include <limits>
#include <random>

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

}  // namespace
}  // namespace scattermeter
