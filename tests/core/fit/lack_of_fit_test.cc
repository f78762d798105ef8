#include "core/fit/lack_of_fit.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Draws that the covariance and the columns describe: p-values are even, and a chosen column takes
// its degree of freedom along. The same with a bump that nothing describes: found.
TEST(LackOfFit, IsEvenWhereTheModelHolds) {
  constexpr Eigen::Index kCells = 24;
  constexpr int kDraws = 4000;
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd root(kCells, kCells);
  for (double& v : root.reshaped()) v = 0.02 * normal(random);
  const Eigen::MatrixXd covariance =
      root * root.transpose() + 1e-4 * Eigen::MatrixXd::Identity(kCells, kCells);
  const Eigen::MatrixXd factor = covariance.llt().matrixL();
  Eigen::MatrixXd free(kCells, 2);
  for (Eigen::Index i = 0; i < kCells; ++i) {
    free(i, 0) = 30.0 * std::cos(0.3 * static_cast<double>(i));  // chosen by a fit
    free(i, 1) = 0.05 * static_cast<double>(i) / kCells;         // known to a deviation
  }
  int below = 0, found = 0;
  double mean_chi2 = 0.0;
  for (int d = 0; d < kDraws; ++d) {
    Eigen::VectorXd z(kCells);
    for (double& v : z) v = normal(random);
    const Eigen::VectorXd rest =
        factor * z + 0.4 * free.col(0) * normal(random) + free.col(1) * normal(random);
    const LackOfFit fit = lack_of_fit(rest, covariance, free, 1);
    EXPECT_EQ(fit.dof, 23.0);
    mean_chi2 += fit.chi2 / kDraws;
    below += fit.p_value < 0.05 ? 1 : 0;
    Eigen::VectorXd bump = Eigen::VectorXd::Zero(kCells);
    bump.segment(5, 3).setConstant(0.5);
    const LackOfFit bumped = lack_of_fit(rest + bump, covariance, free, 1);
    found += bumped.p_value < 1e-6 && bumped.rms > 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(mean_chi2, 23.0, 4.0 * std::sqrt(2.0 * 23.0 / kDraws));
  EXPECT_NEAR(below / static_cast<double>(kDraws), 0.05, 4.0 * std::sqrt(0.05 * 0.95 / kDraws));
  EXPECT_GT(found, kDraws * 99 / 100);
  EXPECT_THROW(lack_of_fit(Eigen::VectorXd::Zero(3), covariance, free, 1), std::invalid_argument);
  EXPECT_THROW(lack_of_fit(Eigen::VectorXd::Zero(kCells), covariance, free, kCells),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
