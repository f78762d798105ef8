#include "core/camera/distortion.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/fixtures/core/derivative_check.h"

namespace scattermeter {
namespace {

// Barrel, pincushion, moustache (folds, then unfolds: k1 < 0 < k2), rational, mostly tangential.
const std::vector<std::vector<double>>& lenses() {
  static const std::vector<std::vector<double>> terms = {
      {-0.3, 0.12, 0.001, -0.0005, -0.02},
      {0.4, 0.1, 0, 0},
      {-0.6, 0.25, 0.0005, 0.001},
      {1.2, 0.4, 0.0005, -0.0008, 0.02, 1.6, 0.9, 0.1},
      {0.01, 0, 0.02, -0.03}};
  return terms;
}

TEST(Distortion, JacobianMatchesCentralDifferences) {
  for (const std::vector<double>& terms : lenses()) {
    const Distortion distortion(terms);
    const Eigen::Vector2d x(0.31, -0.22);
    Eigen::Matrix2d jacobian;
    distortion.apply(x, &jacobian);
    test_support::expect_derivatives(
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return distortion.apply(v.head<2>()); },
        x, jacobian, 1e-8);
  }
}

TEST(Distortion, DomainEndsWhereTheRadialMapTurns) {
  // r (1 + k1 r^2) turns at r = 1 / sqrt(-3 k1).
  EXPECT_NEAR(Distortion({-0.3, 0, 0, 0}).domain_radius(), 1 / std::sqrt(0.9), 1e-12);
  // 1 + 3 k1 s + 5 k2 s^2 with k1 = -0.6, k2 = 0.25: first root s = (1.8 - sqrt(3.24 - 5)) ... has
  // none, so the map only slows; with k2 = 0.1 the first root is s = (1.8 - sqrt(1.24)) / 1.
  EXPECT_NEAR(Distortion({-0.6, 0.1, 0, 0}).domain_radius(), std::sqrt(1.8 - std::sqrt(1.24)),
              1e-12);
  // A denominator's zero at 1 + k4 s = 0.
  EXPECT_NEAR(Distortion({0, 0, 0, 0, 0, -0.25, 0, 0}).domain_radius(), 2, 1e-12);
  EXPECT_DOUBLE_EQ(Distortion({0.4, 0.1, 0, 0}).domain_radius(), 20);
  EXPECT_EQ(Distortion(std::vector<double>{}).domain_radius(),
            std::numeric_limits<double>::infinity());
}

TEST(Distortion, OutsideTheDomainThereIsNoImage) {
  const Distortion barrel({-0.3, 0, 0, 0});
  EXPECT_TRUE(barrel.apply({1.05, 0}).allFinite());
  Eigen::Matrix2d jacobian;
  EXPECT_TRUE(barrel.apply({1.06, 0}, &jacobian).array().isNaN().all());
  EXPECT_TRUE(jacobian.array().isNaN().all());
}

TEST(Distortion, InverseReturnsToThePoint) {
  for (const std::vector<double>& terms : lenses()) {
    const Distortion distortion(terms);
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    // Tangential terms have a fold of their own; 1.0 stays within it for all lenses of the list.
    const double reach = std::min(0.98 * distortion.domain_radius(), 1.0) / std::sqrt(2.0);
    for (int i = 0; i < 2000; ++i) {
      const double u = uniform(random);
      const double v = uniform(random);
      const Eigen::Vector2d x(reach * u, reach * v);
      const Eigen::Vector2d bent = distortion.apply(x);
      const Eigen::Vector2d back = distortion.invert(bent, bent, 1e-14);
      // Where the map is slow its inverse is steep; by its slope (0.02 at the least here) a
      // residual of 1e-14 becomes 5e-13.
      EXPECT_LT((back - x).norm(), 1e-12)
          << "lens " << &terms - lenses().data() << " at " << x.transpose();
    }
  }
}

TEST(Distortion, NoInverseBeyondTheLargestImage) {
  // r (1 - 0.3 r^2) is at most (2 / 3) / sqrt(0.9) = 0.7027.
  const Distortion barrel({-0.3, 0, 0, 0});
  const auto inverse_at = [&](double r) {
    const Eigen::Vector2d bent(0.6 * r, 0.8 * r);
    return barrel.invert(bent, bent, 1e-14);
  };
  EXPECT_TRUE(inverse_at(0.7026).allFinite());
  EXPECT_FALSE(inverse_at(0.7028).allFinite());
  EXPECT_FALSE(inverse_at(5).allFinite());
  EXPECT_FALSE(inverse_at(std::nan("")).allFinite());
}

TEST(Distortion, InverseStaysOnTheSheetOfTheAxis) {
  // 1 - 0.6 r^2 + 0.1 r^4: folds at r = 0.83 and unfolds farther out, so its images have a second
  // and a third original. A bad guess among those must not be taken up.
  const Distortion lens({-0.6, 0.1, 0, 0});
  const Eigen::Vector2d x(0.3, 0.2);
  const Eigen::Vector2d bent = lens.apply(x);
  for (const double guess : {-3.0, 0.0, 0.82, 1.2, 2.5}) {
    EXPECT_LT((lens.invert(bent, {guess, guess}, 1e-14) - x).norm(), 1e-12) << guess;
  }
}

TEST(Distortion, IdentityIsExact) {
  const Distortion none({0, 0, 0, 0, 0});
  EXPECT_TRUE(none.is_identity());
  const Eigen::Vector2d x(123.4, -5e6);
  EXPECT_EQ(none.apply(x), x);
  EXPECT_EQ(none.invert(x, {0, 0}, 0), x);
}

TEST(Distortion, RefusesOtherTerms) {
  EXPECT_THROW(Distortion({0.1}), std::invalid_argument);
  EXPECT_THROW(Distortion(std::vector<double>(12, 0.0)), std::invalid_argument);
  EXPECT_THROW(Distortion({0.1, std::nan(""), 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
