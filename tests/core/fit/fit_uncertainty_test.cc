#include "core/fit/fit_uncertainty.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "core/fit/dipole_fit.h"
#include "tests/fixtures/core/half_lit_plate.h"

namespace scattermeter {
namespace {

// A plate whose image moves along two nuisance columns (a tilt along x and one along y of the
// light).
class TiltedLight : public ::testing::Test {
 protected:
  DenseSystem system(unsigned seed, double tilt_x, double tilt_y) {
    const Eigen::VectorXd clean = l_ + tilt_x * columns_.col(0) + tilt_y * columns_.col(1);
    DenseSystem s = test_support::noisy_system(weights_, clean, 0.01, seed);
    s.nuisances = {{"tilt x", 0.05, true}, {"tilt y", 0.05, true}};
    s.nuisance_columns = columns_;
    return s;
  }
  void SetUp() override {
    columns_.resize(l_.size(), 2);
    for (std::size_t j = 0; j < plate_.rows().size(); ++j) {
      const Eigen::Vector3d c = plate_.patches().center_mm(plate_.rows()[j]);
      columns_.row(static_cast<Eigen::Index>(j)) =
          l_[static_cast<Eigen::Index>(j)] * Eigen::RowVector2d(c.x() / 15.0, c.y() / 3.0);
    }
  }
  test_support::HalfLitPlate plate_{1.0};
  DistanceKnots knots_ = plate_.knots();
  WeightMatrix weights_ = plate_.weights(knots_);
  Eigen::VectorXd l_ = plate_.image(Dipole({1.2, 0.004, 1.3}));
  Eigen::MatrixXd columns_;
};

// Nuisances drawn from their priors: the answer's scatter is what the fit predicts, and without the
// nuisances in the fit it would be far larger. 60 seeds know a deviation to 9 %.
TEST_F(TiltedLight, PredictsTheScatterOfDrawnNuisances) {
  constexpr int kSeeds = 60;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  DipoleFitOptions options;
  Eigen::ArrayXd s(kSeeds), a(kSeeds), blind(kSeeds);
  double predicted_s = 0.0, predicted_a = 0.0;
  for (int i = 0; i < kSeeds; ++i) {
    DenseSystem drawn =
        system(static_cast<unsigned>(i + 1), 0.05 * normal(random), 0.05 * normal(random));
    const Estimate e = fit_dipole(drawn, knots_, options).estimate;
    ASSERT_TRUE(e.converged);
    EXPECT_NEAR(e.reduced_chi2, 1.0, 0.3);
    s[i] = e.sigma_s_prime_per_mm.value;
    a[i] = e.sigma_a_per_mm.value;
    predicted_s += e.sigma_s_prime_per_mm.std / kSeeds;
    predicted_a += e.sigma_a_per_mm.std / kSeeds;
    drawn.nuisances.clear();
    drawn.nuisance_columns.resize(0, 0);
    blind[i] = fit_dipole(drawn, knots_, options).estimate.sigma_a_per_mm.value;
  }
  const auto spread = [](const Eigen::ArrayXd& v, double truth) {
    return std::sqrt((v - truth).square().mean());
  };
  EXPECT_NEAR(spread(s, 1.2) / predicted_s, 1.0, 0.3);
  EXPECT_NEAR(spread(a, 0.004) / predicted_a, 1.0, 0.3);
  EXPECT_GT(spread(blind, 0.004), 1.3 * spread(a, 0.004));
}

TEST_F(TiltedLight, BudgetNamesEveryCause) {
  DipoleFitOptions options;
  options.scale.relative_std = 0.02;
  const Estimate e = fit_dipole(system(3, 0.0, 0.0), knots_, options).estimate;
  ASSERT_EQ(e.budget.size(), 4U);
  EXPECT_EQ(e.budget[0].cause, "noise");
  EXPECT_EQ(e.budget[1].cause, "scale");
  EXPECT_EQ(e.budget[2].cause, "tilt x");
  double largest = 0.0;
  for (const BudgetLine& line : e.budget) {
    EXPECT_LE(line.std_sigma_a_per_mm, e.sigma_a_per_mm.std * (1 + 1e-9));
    largest = std::max(largest, line.std_sigma_a_per_mm);
  }
  EXPECT_GT(largest, 0.3 * e.sigma_a_per_mm.std);
  EXPECT_GT(e.budget[2].std_sigma_s_prime_per_mm, 0.0);
}

// Without any tilt, answers scatter as the budget's noise says, which holds what the fit takes on
// to be less sensitive to tilts: with exactly known ones, it scatters less.
TEST_F(TiltedLight, BudgetKnowsTheScatterByNoiseAlone) {
  constexpr int kSeeds = 200;
  Eigen::ArrayXd s(kSeeds);
  double predicted = 0.0, of_known = 0.0;
  for (int i = 0; i < kSeeds; ++i) {
    DenseSystem drawn = system(static_cast<unsigned>(i + 1), 0.0, 0.0);
    const Estimate e = fit_dipole(drawn, knots_, {}).estimate;
    s[i] = e.sigma_s_prime_per_mm.value;
    predicted += e.budget.front().std_sigma_s_prime_per_mm / kSeeds;
    drawn.nuisances.clear();
    drawn.nuisance_columns.resize(0, 0);
    of_known += fit_dipole(drawn, knots_, {}).estimate.sigma_s_prime_per_mm.std / kSeeds;
  }
  // 200 seeds know a deviation to 5 %.
  EXPECT_NEAR(std::sqrt((s - 1.2).square().mean()) / predicted, 1.0, 0.15);
  EXPECT_GT(predicted, 1.05 * of_known);
}

// A nuisance that is held: the answer is the one without it, the uncertainty holds its push. Drawn
// from its prior, the answers scatter as predicted.
TEST_F(TiltedLight, HeldNuisanceWidensOnly) {
  constexpr int kSeeds = 60;
  std::mt19937 random(6);
  std::normal_distribution<double> normal;
  Eigen::ArrayXd a(kSeeds);
  double predicted = 0.0;
  for (int i = 0; i < kSeeds; ++i) {
    DenseSystem drawn = system(static_cast<unsigned>(i + 1), 0.005 * normal(random), 0.0);
    drawn.nuisances = {{"tilt x", 0.005, false}};
    drawn.nuisance_columns = columns_.leftCols(1).eval();
    const Estimate held = fit_dipole(drawn, knots_, {}).estimate;
    a[i] = held.sigma_a_per_mm.value;
    predicted += held.sigma_a_per_mm.std / kSeeds;
    if (i > 0) continue;
    drawn.nuisances.clear();
    drawn.nuisance_columns.resize(0, 0);
    const Estimate without = fit_dipole(drawn, knots_, {}).estimate;
    EXPECT_NEAR(held.sigma_a_per_mm.value, without.sigma_a_per_mm.value, 1e-9);
    EXPECT_GT(held.sigma_a_per_mm.std, 1.05 * without.sigma_a_per_mm.std);
  }
  EXPECT_NEAR(std::sqrt((a - 0.004).square().mean()) / predicted, 1.0, 0.3);
}

// An exact scale and no nuisances: noise is all there is.
TEST_F(TiltedLight, NoiseAlone) {
  DenseSystem s = system(4, 0.0, 0.0);
  s.nuisances.clear();
  s.nuisance_columns.resize(0, 0);
  const Estimate e = fit_dipole(s, knots_, {}).estimate;
  ASSERT_EQ(e.budget.size(), 1U);
  EXPECT_DOUBLE_EQ(e.budget[0].std_sigma_a_per_mm, e.sigma_a_per_mm.std);
  EXPECT_EQ(e.scale.std, 0.0);
}

}  // namespace
}  // namespace scattermeter
