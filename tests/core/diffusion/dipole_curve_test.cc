#include "core/diffusion/dipole_curve.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/core/derivative_check.h"

namespace scattermeter {
namespace {

TEST(DipoleCurve, ParametersAreTheMediums) {
  const Medium m = medium_of(std::log(2.5), 0.2, 1.4);
  EXPECT_NEAR(m.sigma_s_prime_per_mm, 2.0, 1e-14);
  EXPECT_NEAR(m.sigma_a_per_mm, 0.5, 1e-14);
  EXPECT_EQ(m.eta_int_over_ext, 1.4);
}

TEST(DipoleCurve, DerivativesMeetDifferences) {
  const DistanceKnots knots(0.05, 30.0);
  for (const auto& [u, q] : {std::pair{std::log(2.19), 1e-3}, std::pair{-1.0, 0.3}}) {
    const DipoleCurve c = dipole_curve(knots, u, q, 1.3);
    Eigen::MatrixXd jacobian(knots.size(), 2);
    jacobian << c.d_u, c.d_q;
    test_support::expect_derivatives(
        [&](const Eigen::VectorXd& x) { return dipole_curve(knots, x[0], x[1], 1.3).r; },
        Eigen::Vector2d(u, q), jacobian, 1e-5);
  }
}

}  // namespace
}  // namespace scattermeter
