#include "core/fit/excess_scatter.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Rows with noise, an error of paths and `extra` times its variance from elsewhere.
double found(double extra, double noise, unsigned seed) {
  constexpr Eigen::Index kRows = 4000;
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd residual(kRows), noise2(kRows), paths2(kRows);
  for (Eigen::Index i = 0; i < kRows; ++i) {
    const double l = 1.0 + static_cast<double>(i % 7);
    noise2[i] = noise * noise * l;
    paths2[i] = 1e-2 * l;
    residual[i] = std::sqrt(noise2[i] + (1.0 + extra) * paths2[i]) * normal(random);
  }
  return excess_scatter(residual, noise2, paths2, (noise2 + paths2).cwiseInverse());
}

TEST(ExcessScatter, TellsWhatNoiseDoesNot) {
  // 4000 rows: 2.2 % of a variance.
  EXPECT_NEAR(found(0.0, 0.05, 1), 1.0, 0.1);
  EXPECT_NEAR(found(3.0, 0.05, 2), 4.0, 0.4);
  // Ten times as much noise as Monte Carlo error: the noise is told from the rest still.
  EXPECT_NEAR(found(20.0, 0.3, 3), 21.0, 3.0);
}

TEST(ExcessScatter, NeverBelowOne) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(5);
  EXPECT_EQ(excess_scatter(Eigen::VectorXd::Zero(5), one, one, one), 1.0);
  EXPECT_EQ(excess_scatter(one, one, Eigen::VectorXd::Zero(5), one), 1.0);
  EXPECT_THROW(excess_scatter(one, one, Eigen::VectorXd::Ones(4), one), std::invalid_argument);
}

// The limit is what excess_scatter() reports of rows that scatter by just that share.
TEST(ExcessScatter, MostIsThatOfAShareOfTheLight) {
  const Eigen::Vector3d light(4.0, 10.0, 20.0), paths(0.01, 0.02, 0.04), weights(3.0, 1.0, 0.5);
  const Eigen::Vector3d residual = (paths + 0.0009 * light.cwiseAbs2()).cwiseSqrt();
  EXPECT_NEAR(most_scatter(0.03, light, paths, weights),
              excess_scatter(residual, Eigen::Vector3d::Zero(), paths, weights), 1e-12);
  EXPECT_EQ(most_scatter(0.03, light, Eigen::Vector3d::Zero(), weights), 1.0);
}

}  // namespace
}  // namespace scattermeter
