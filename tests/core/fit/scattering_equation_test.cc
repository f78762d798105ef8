#include "core/fit/scattering_equation.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

constexpr Eigen::Index kEquationRows = 200;

// A made-up image of two coefficients with exact derivatives, not linear in them.
ScatteringImage image_of(double s, double a) {
  ScatteringImage m;
  m.l.resize(kEquationRows);
  m.per_log_sigma_s.resize(kEquationRows);
  m.per_sigma_a.resize(kEquationRows);
  for (Eigen::Index j = 0; j < kEquationRows; ++j) {
    const double x = 0.05 + static_cast<double>(j) / kEquationRows;
    const double l = std::pow(s, 0.3 + 0.4 * x) * std::exp(-a * (3.0 + 40.0 * x * x));
    m.l[j] = l;
    m.per_log_sigma_s[j] = (0.3 + 0.4 * x) * l;
    m.per_sigma_a[j] = -(3.0 + 40.0 * x * x) * l;
  }
  m.variance = Eigen::VectorXd::Constant(kEquationRows, 1e-8);
  return m;
}

DenseSystem system_of(const Eigen::VectorXd& l, double std) {
  DenseSystem system;
  system.l = l;
  system.std_l = Eigen::VectorXd::Constant(l.size(), std);
  return system;
}

// Both halves of the paths alike.
PathHalves twice(const ScatteringImage& m) { return {m, m}; }

ScatteringPoint solved(const DenseSystem& system, const ScalePrior& prior, ScatteringPoint at,
                       ScatteringEquation::Step* last = nullptr) {
  for (int i = 0; i < 12; ++i) {
    const ScatteringImage pilot = image_of(at.sigma_s_per_mm * 1.05, at.sigma_a_per_mm);
    const ScatteringEquation equation(system, prior, pilot, at);
    const Eigen::Index n = equation.projection(0).rows();
    const ScatteringEquation::Step step = equation.step(
        twice(image_of(at.sigma_s_per_mm, at.sigma_a_per_mm)), Eigen::MatrixXd::Zero(n, n), at);
    at = step.to;
    if (last != nullptr) *last = step;
  }
  return at;
}

// The root is the truth, wherever the search and its pilots stand.
TEST(ScatteringEquation, FindsTheTruth) {
  const ScatteringImage truth = image_of(2.0, 0.01);
  const ScatteringPoint exact = solved(system_of(truth.l, 1e-3), {0.0}, {0.7, 0.0, 1.0});
  EXPECT_NEAR(exact.sigma_s_per_mm, 2.0, 1e-9);
  EXPECT_NEAR(exact.sigma_a_per_mm, 0.01, 1e-11);
  EXPECT_EQ(exact.scale, 1.0);
  const ScatteringPoint free = solved(system_of(1.7 * truth.l, 1e-3),
                                      {std::numeric_limits<double>::infinity()}, {3.0, 0.02, 1.0});
  EXPECT_NEAR(free.sigma_s_per_mm, 2.0, 1e-6);
  EXPECT_NEAR(free.sigma_a_per_mm, 0.01, 1e-7);
  EXPECT_NEAR(free.scale, 1.7, 1e-6);
}

// Deviations of many noisy images, with Monte Carlo noise in m, are the stated ones; no bias.
TEST(ScatteringEquation, DeviationsAreAsStated) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  const ScatteringPoint at{2.0, 0.01, 1.0};
  const ScatteringImage truth = image_of(2.0, 0.01);
  const ScatteringImage pilot = image_of(2.1, 0.009);
  const double noise = 2e-3, paths = 3e-3;
  constexpr int kDraws = 3000;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d stated = Eigen::Matrix2d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    DenseSystem system = system_of(truth.l, noise);
    ScatteringImage m = truth;
    for (Eigen::Index j = 0; j < kEquationRows; ++j) {
      system.l[j] += noise * normal(random);
      m.l[j] += paths * normal(random);
    }
    const ScatteringEquation equation(system, {0.0}, pilot, at);
    const Eigen::MatrixXd of_paths =
        paths * paths * equation.projection(0) * equation.projection(0).transpose();
    const ScatteringEquation::Step step = equation.step(twice(m), of_paths, at);
    const Eigen::Vector2d off(std::log(step.to.sigma_s_per_mm / 2.0),
                              step.to.sigma_a_per_mm - 0.01);
    sum += off / kDraws;
    square += off * off.transpose() / kDraws;
    stated += step.covariance / kDraws;
  }
  // 3000 draws: 1.3 % of a deviation; four of that, and of the mean.
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double std = std::sqrt(stated(k, k));
    EXPECT_NEAR(std::sqrt(square(k, k)) / std, 1.0, 0.052);
    EXPECT_LT(std::abs(sum[k]), 4.0 * std / std::sqrt(kDraws));
  }
}

// Where the pilots are as noisy as the paths, and come from the same ones, halves that weigh each
// other leave the root unbiased and the deviations as stated; weights for the image that they come
// from do not.
TEST(ScatteringEquation, HalvesWeighEachOther) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const ScatteringPoint at{2.0, 0.01, 1.0};
  const ScatteringImage truth = image_of(2.0, 0.01);
  constexpr double kNoise = 1e-3, kPaths = 2e-2, kSlope = 2.0;  // of a half; of d / d log sigma_s
  constexpr int kDraws = 1500;
  double crossed_sum = 0.0, square = 0.0, stated = 0.0, own_sum = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    DenseSystem system = system_of(truth.l, kNoise);
    for (double& l : system.l) l += kNoise * normal(random);
    PathHalves halves = twice(truth);
    std::vector<EquationPilot> pilots;
    for (ScatteringImage& m : halves) {
      for (Eigen::Index j = 0; j < kEquationRows; ++j) {
        const double error = kPaths * normal(random);
        m.l[j] += error;
        m.per_log_sigma_s[j] += kSlope * error;
      }
      pilots.push_back({m, {}});
      pilots.back().image.l = truth.l;
      pilots.back().image.variance.setConstant(0.5 * kPaths * kPaths);
    }
    const ScatteringEquation crossed(system, {0.0}, pilots, at);
    Eigen::Matrix2d of_paths = Eigen::Matrix2d::Zero();
    for (const std::size_t half : {0U, 1U}) {
      const Eigen::MatrixXd& p = crossed.projection(half);
      of_paths += 0.25 * kPaths * kPaths * p * p.transpose();
    }
    const ScatteringEquation::Step step = crossed.step(halves, of_paths, at);
    crossed_sum += step.move[0] / kDraws;
    square += step.move[0] * step.move[0] / kDraws;
    stated += step.covariance(0, 0) / kDraws;
    std::swap(pilots[0], pilots[1]);
    own_sum +=
        ScatteringEquation(system, {0.0}, pilots, at).step(halves, of_paths, at).move[0] / kDraws;
  }
  const double std = std::sqrt(stated);
  EXPECT_NEAR(std::sqrt(square) / std, 1.0, 0.08);
  EXPECT_LT(std::abs(crossed_sum), 4.0 * std / std::sqrt(kDraws));
  EXPECT_GT(std::abs(own_sum), 0.5 * std);
}

// A pilot whose derivative has detail that the image lacks wastes most of what the rows tell;
// with the smooth derivative among the instruments, the paths themselves show which one holds. The
// noise of their derivatives, which is that of their light many times over, biases neither the root
// nor its deviation.
TEST(ScatteringEquation, InstrumentsReplaceWrongDetail) {
  std::mt19937 random(21);
  std::normal_distribution<double> normal;
  const ScatteringPoint at{2.0, 0.01, 1.0};
  const ScatteringImage truth = image_of(2.0, 0.01);
  const double paths = 3e-3, of_derivatives = 8.0;
  EquationPilot plain{image_of(2.0, 0.01)};
  Eigen::MatrixXd smooth(kEquationRows, 3);
  smooth << plain.image.per_log_sigma_s, plain.image.per_sigma_a, plain.image.l;
  for (Eigen::Index j = 0; j < kEquationRows; ++j) {
    plain.image.per_log_sigma_s[j] += (j % 2 == 0 ? 2.0 : -2.0) * plain.image.l[j];
  }
  plain.image.variance.setConstant(paths * paths);
  EquationPilot with = plain;
  with.further = smooth;
  with.expected = Eigen::MatrixXd::Zero(5, 2);
  with.expected(0, 0) = with.expected(1, 1) = with.expected(2, 0) = with.expected(3, 1) = 0.5;
  const auto step_of = [&](const EquationPilot& pilot, const DenseSystem& system,
                           const PathHalves& m) {
    const ScatteringEquation equation(system, {0.0}, {pilot}, at);
    return equation.step(
        m, paths * paths * equation.projection(0) * equation.projection(0).transpose(), at);
  };
  constexpr int kDraws = 2000;
  double sum = 0.0, square = 0.0, stated = 0.0, wasted = 0.0, promised = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    PathHalves m = {truth, truth};
    for (ScatteringImage& half : m) {
      for (Eigen::Index j = 0; j < kEquationRows; ++j) {
        const double off = std::sqrt(2.0) * paths * normal(random);
        half.l[j] += off;
        half.per_log_sigma_s[j] += of_derivatives * off;
        half.per_sigma_a[j] -= 30.0 * off;
      }
    }
    const DenseSystem system = system_of(truth.l, 1e-6);
    const ScatteringEquation::Step step = step_of(with, system, m);
    const double off = step.move[0];
    sum += off / kDraws;
    square += off * off / kDraws;
    stated += step.covariance(0, 0) / kDraws;
    promised += step.promised(0, 0) / kDraws;
    wasted += step_of(plain, system, m).covariance(0, 0) / kDraws;
  }
  // 2000 draws: 1.6 % of a deviation; four of that, and of the mean.
  EXPECT_NEAR(std::sqrt(square / stated), 1.0, 0.064);
  EXPECT_LT(std::abs(sum), 4.0 * std::sqrt(stated / kDraws));
  EXPECT_LT(stated, 0.1 * wasted);
  EXPECT_NEAR(stated / promised, 1.0, 0.1);
}

// Where noise takes the root to a negative sigma_a, the step ends at the least squares of sigma_s
// alone, without absorption.
TEST(ScatteringEquation, AtTheBoundOfSigmaATheOthersAreMostProbable) {
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const ScatteringPoint at{2.0, 0.002, 1.0};
  const ScatteringImage m = image_of(at.sigma_s_per_mm, at.sigma_a_per_mm);
  int bound = 0;
  for (int draw = 0; draw < 20; ++draw) {
    DenseSystem system = system_of(m.l - 0.003 * m.per_sigma_a, 1e-2);
    for (double& l : system.l) l += 1e-2 * normal(random);
    ScatteringImage pilot = m;
    pilot.variance.setZero();
    const ScatteringEquation equation(system, {0.0}, pilot, at);
    const ScatteringEquation::Step step = equation.step(twice(m), Eigen::MatrixXd::Zero(2, 2), at);
    if (at.sigma_a_per_mm + step.move[1] >= 0.0) {
      EXPECT_EQ(step.taken, step.move);
      continue;
    }
    ++bound;
    const Eigen::VectorXd without = system.l - (m.l - at.sigma_a_per_mm * m.per_sigma_a);
    const double alone = m.per_log_sigma_s.dot(without) / m.per_log_sigma_s.squaredNorm();
    EXPECT_NEAR(step.taken[0], alone, 1e-9);
    EXPECT_NEAR(step.to.sigma_s_per_mm, 2.0 * std::exp(alone), 1e-8);
    EXPECT_NEAR(step.to.sigma_a_per_mm, 0.0, 1e-15);
    EXPECT_GT(std::abs(step.move[0] - alone), 1e-4);
  }
  EXPECT_GE(bound, 8);
}

// A nuisance that the rows cannot tell apart from the medium widens the answer; the causes add up.
TEST(ScatteringEquation, NuisancesWiden) {
  const ScatteringImage truth = image_of(2.0, 0.01);
  DenseSystem system = system_of(truth.l, 1e-3);
  ScatteringEquation::Step plain, wide;
  solved(system, {0.0}, {2.0, 0.01, 1.0}, &plain);
  system.nuisances = {{"eta", 0.05, true}};
  system.nuisance_columns = truth.per_log_sigma_s;
  solved(system, {0.0}, {2.0, 0.01, 1.0}, &wide);
  EXPECT_GT(wide.covariance(0, 0), plain.covariance(0, 0));
  EXPECT_NEAR(std::sqrt(wide.covariance(0, 0)), 0.05, 0.01);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(2, 2);
  bool named = false;
  for (const auto& cause : wide.causes) {
    sum += cause.covariance;
    named = named || cause.name == "eta";
  }
  EXPECT_TRUE(named);
  EXPECT_LT((sum - wide.covariance).norm(), 1e-12 * sum.norm());
}

// What a nuisance changes beyond its column moves the estimate as the image would, here as a change
// of the medium, and has no part in the weights.
TEST(ScatteringEquation, ChangesBeyondAColumnWiden) {
  const ScatteringPoint at{2.0, 0.01, 1.0};
  const ScatteringImage truth = image_of(2.0, 0.01);
  DenseSystem system = system_of(truth.l, 1e-3);
  const Eigen::VectorXd column = 0.1 * truth.l;
  system.nuisance_columns = column;
  system.nuisances = {{"eta", 0.02, true, "eta"}};
  const ScatteringEquation plain(system, {0.0}, truth, at);
  const Eigen::Index n = plain.projection(0).rows();
  const ScatteringEquation::Step without =
      plain.step(twice(truth), Eigen::MatrixXd::Zero(n, n), at);
  system.beyond_column = {0, -1.5 * truth.per_log_sigma_s + 0.03 * truth.per_sigma_a};
  const ScatteringEquation equation(system, {0.0}, truth, at);
  const ScatteringEquation::Step with =
      equation.step(twice(truth), Eigen::MatrixXd::Zero(n, n), at);
  EXPECT_EQ(equation.projection(0), plain.projection(0));
  const Eigen::Vector2d moved = with.common_causes.col(0) - without.common_causes.col(0);
  EXPECT_NEAR(moved[0], -0.03, 1e-9);
  EXPECT_NEAR(moved[1], 0.0006, 1e-9);
  const Eigen::Vector2d all = with.common_causes.col(0), own = without.common_causes.col(0);
  EXPECT_LT(
      (with.covariance - without.covariance - all * all.transpose() + own * own.transpose()).norm(),
      1e-12);
}

// The residual at the end of a step is that of the image there, and what a nuisance with a wide
// prior makes of it can be told and taken off.
TEST(ScatteringEquation, Residual) {
  const ScatteringImage truth = image_of(2.0, 0.01);
  DenseSystem system = system_of(truth.l, 1e-3);
  ScatteringImage quiet = truth;
  quiet.variance.setZero();
  const ScatteringPoint at{2.0, 0.01, 1.0};
  const ScatteringPoint beside{2.004, 0.01001, 1.001};
  const ScatteringEquation equation(system, {0.0}, quiet, at);
  EXPECT_LT(equation.residual(truth, at, at).norm(), 1e-12);
  const ScatteringImage there = image_of(2.004, 0.01001);
  EXPECT_LT((equation.residual(truth, at, beside) - (truth.l - 1.001 * there.l)).norm(),
            0.005 * (truth.l - 1.001 * there.l).norm());
  Eigen::VectorXd wave(kEquationRows);
  for (Eigen::Index j = 0; j < kEquationRows; ++j) wave[j] = std::sin(0.1 * static_cast<double>(j));
  system.nuisances = {{"wave", 1.0, true}};
  system.nuisance_columns = wave;
  const ScatteringEquation wavy(system, {0.0}, quiet, at);
  EXPECT_LT(wavy.without_nuisances(0.3 * wave).norm(), 1e-4 * wave.norm());
  quiet.l.conservativeResize(3);
  EXPECT_THROW(ScatteringEquation(system, {0.0}, quiet, at), std::invalid_argument);
}

// What a nuisance and the scale's error move is what the equation answers to them.
TEST(ScatteringEquation, Pushes) {
  const ScatteringImage truth = image_of(2.0, 0.01);
  DenseSystem system = system_of(truth.l, 1e-3);
  system.nuisances = {{"tilt", 0.02, true}};
  system.nuisance_columns =
      truth.l.cwiseProduct(Eigen::VectorXd::LinSpaced(kEquationRows, -1.0, 1.0));
  const ScatteringPoint at{2.0, 0.01, 1.0};
  const ScatteringEquation equation(system, {0.02}, truth, at);
  ASSERT_EQ(equation.projection(0).rows(), 2);  // a scale with a prior is a nuisance
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(2, 2);
  const ScatteringEquation::Step nominal = equation.step(twice(truth), none, at);
  ASSERT_EQ(nominal.common_causes.cols(), 2);
  DenseSystem pushed = system;
  const ScatteringEquation same(pushed, {0.02}, truth, at);
  pushed.l += 0.02 * system.nuisance_columns;
  EXPECT_LT((same.step(twice(truth), none, at).move - nominal.common_causes.col(0)).norm(),
            1e-9 * nominal.common_causes.col(0).norm());
  pushed.l = 1.02 * truth.l;
  EXPECT_LT((same.step(twice(truth), none, at).move - nominal.common_causes.col(1)).norm(),
            1e-9 * nominal.common_causes.col(1).norm());
  // The image says where in its prior the scale lies, as far as the medium does not answer for it.
  EXPECT_NEAR(same.settled_log_scale(same.residual(truth, at, at)), 0.02, 0.002);
  EXPECT_EQ(ScatteringEquation(system, {0.0}, truth, at).settled_log_scale(truth.l), 0.0);
}

// Weights that know how rows err together make the answer less uncertain, and leave it unbiased.
TEST(ScatteringEquation, CorrelatedErrors) {
  const ScatteringImage truth = image_of(2.0, 0.01);
  const DenseSystem system = system_of(truth.l, 1e-4);
  const ScatteringPoint at{2.0, 0.01, 1.0};
  Eigen::MatrixXd alike(kEquationRows, 2);
  alike << 0.02 * truth.l,
      0.02 * truth.l.cwiseProduct(Eigen::VectorXd::LinSpaced(kEquationRows, -1, 1));
  const auto std_of = [&](const ScatteringEquation& e) {
    const Eigen::MatrixXd p = e.projection(0) * alike;
    return std::sqrt(e.step(twice(truth), p * p.transpose(), at).covariance(1, 1));
  };
  const ScatteringEquation blind(system, {0.0}, truth, at);
  const CorrelatedErrors groups{alike.sparseView(), Eigen::Matrix2d::Identity()};
  const ScatteringEquation knowing(system, {0.0}, std::vector<EquationPilot>{{truth, groups}}, at);
  EXPECT_LT(std_of(knowing), 0.3 * std_of(blind));
  const ScatteringEquation::Step step = knowing.step(twice(truth), Eigen::MatrixXd::Zero(2, 2), at);
  EXPECT_LT(step.move.norm(), 1e-9);
  const CorrelatedErrors fewer{alike.topRows(3).sparseView(), Eigen::Matrix2d::Identity()};
  EXPECT_THROW(ScatteringEquation(system, {0.0}, std::vector<EquationPilot>{{truth, fewer}}, at),
               std::invalid_argument);
  EXPECT_THROW(ScatteringEquation(system, {0.0}, std::vector<EquationPilot>{}, at),
               std::invalid_argument);
}

// Scatter beyond the noise is a cause of its own, as correlated as the paths.
TEST(ScatteringEquation, ScatterWidens) {
  const ScatteringImage truth = image_of(2.0, 0.01);
  const DenseSystem system = system_of(truth.l, 1e-3);
  const ScatteringPoint at{2.0, 0.01, 1.0};
  const ScatteringEquation equation(system, {0.0}, truth, at);
  const Eigen::MatrixXd paths = 1e-6 * equation.projection(0) * equation.projection(0).transpose();
  const auto plain = equation.step(twice(truth), paths, at);
  const auto wide = equation.step(twice(truth), paths, at, 5.0);
  EXPECT_LT(
      (wide.covariance - plain.covariance -
       4.0 * equation.step(twice(truth), paths, at).inverse * paths * plain.inverse.transpose())
          .norm(),
      1e-12 * wide.covariance.norm());
  EXPECT_EQ(wide.causes.size(), plain.causes.size() + 1);
}

// A scale that is stated wrongly shows, by as much as it is wrong, where the medium cannot make up
// for it; a true one does not, more often than its p-value says.
TEST(ScatteringEquation, DoubtsAScale) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const ScatteringPoint at{2.0, 0.01, 1.0};
  const ScatteringImage truth = image_of(2.0, 0.01);
  const ScatteringImage pilot = image_of(2.05, 0.0095);
  constexpr double kNoise = 2e-3;
  constexpr double kPaths = 1e-3;
  constexpr double kPrior = 0.02;
  for (const double prior : {0.0, kPrior}) {
    for (const double off : {0.0, 0.05}) {
      constexpr int kDraws = 1000;
      double sum = 0.0, square = 0.0, std = 0.0;
      int significant = 0;
      for (int i = 0; i < kDraws; ++i) {
        const double drawn = off + prior * normal(random);
        DenseSystem system = system_of(std::exp(drawn) * truth.l, kNoise);
        ScatteringImage m = truth;
        for (Eigen::Index j = 0; j < kEquationRows; ++j) {
          system.l[j] += kNoise * normal(random);
          m.l[j] += kPaths * normal(random);
        }
        const ScatteringEquation equation(system, {prior}, pilot, at);
        const Eigen::RowVectorXd& form = equation.scale_form(0);
        ASSERT_EQ(form.size(), kEquationRows);
        EXPECT_NEAR(form.dot(pilot.l), 1.0, 1e-9);
        EXPECT_NEAR(form.dot(pilot.per_log_sigma_s), 0.0, 1e-8);
        EXPECT_NEAR(form.dot(pilot.per_sigma_a), 0.0, 1e-6);
        const ScatteringEquation::Step step =
            equation.step(twice(m), Eigen::MatrixXd::Zero(2, 2), at);
        const ScatteringEquation::ScaleTest test = equation.scale_test(
            {equation.residual(m, at, step.to), equation.residual(m, at, step.to)},
            kPaths * kPaths * form.squaredNorm(), 1.0);
        sum += test.offset / kDraws;
        square += (test.offset - off) * (test.offset - off) / kDraws;
        std = test.std;
        significant += test.p_value < 0.01 ? 1 : 0;
      }
      // 1000 draws: 2.2 % of a deviation.
      EXPECT_NEAR(std::sqrt(square) / std, 1.0, 0.1) << prior << " " << off;
      EXPECT_NEAR(sum, off, 4.0 * std / std::sqrt(kDraws) + 0.02 * off) << prior << " " << off;
      if (off == 0.0) {
        EXPECT_LE(significant, 25) << prior;  // of 1000, 10 expected
      } else if (prior == 0.0) {
        EXPECT_GE(significant, 900) << std;
      }
    }
  }
  // A free scale leaves nothing to test.
  const ScatteringEquation free(system_of(truth.l, kNoise),
                                {std::numeric_limits<double>::infinity()}, pilot, at);
  EXPECT_EQ(free.scale_form(0).size(), 0);
  EXPECT_EQ(free.scale_test({truth.l, truth.l}, 0.0, 1.0).p_value, 1.0);
}

// An offset of the scale widens the step by as much as it would move the estimate.
TEST(ScatteringEquation, ContradictedScaleWidens) {
  const ScatteringImage truth = image_of(2.0, 0.01);
  const ScatteringPoint at{2.0, 0.01, 1.0};
  const DenseSystem system = system_of(truth.l, 1e-3);
  const ScatteringEquation equation(system, {0.0}, truth, at);
  ScatteringEquation::Step step = equation.step(twice(truth), Eigen::MatrixXd::Zero(2, 2), at);
  const Eigen::MatrixXd before = step.covariance;
  equation.widen_by_scale(0.05, step);
  const DenseSystem brighter = system_of(1.05 * truth.l, 1e-3);
  const ScatteringEquation other(brighter, {0.0}, truth, at);
  const Eigen::VectorXd moved = other.step(twice(truth), Eigen::MatrixXd::Zero(2, 2), at).move;
  for (Eigen::Index k = 0; k < 2; ++k) {
    EXPECT_NEAR(step.covariance(k, k), before(k, k) + moved[k] * moved[k],
                1e-6 * step.covariance(k, k));
  }
  EXPECT_EQ(step.causes.back().name, "doubted scale");
}

}  // namespace
}  // namespace scattermeter
