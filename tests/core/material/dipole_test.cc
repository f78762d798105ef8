#include "core/material/dipole.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/fixtures/core/derivative_check.h"

namespace scattermeter {
namespace {

const Medium kDipoleMedia[] = {{2.19, 0.002, 1.3}, {0.74, 0.032, 1.3},  {2.62, 0.0041, 1.5},
                               {0.15, 0.015, 1.3}, {7.38, 0.0002, 1.3}, {2.19, 0.0, 1.3}};

// The plane's integral of R is a closed form (Jensen et al. 2001, total diffuse reflectance).
TEST(Dipole, IntegralOverThePlaneIsTheTotal) {
  for (const Medium& m : kDipoleMedia) {
    if (m.sigma_a_per_mm == 0.0) continue;
    const Dipole dipole(m);
    const int n = 200'000;
    const double a = std::log(1e-6 * dipole.z_r_mm());
    const double b = std::log(60.0 / dipole.sigma_tr_per_mm());
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      const double rho = std::exp(a + (i + 0.5) / n * (b - a));
      sum += dipole.reflectance_per_mm2(rho) * 2.0 * std::numbers::pi * rho * rho * (b - a) / n;
    }
    EXPECT_NEAR(sum, dipole.total_reflectance(), 1e-6);
  }
}

// Values of dipole_Rd_formula in a table of measured materials that comes from elsewhere.
TEST(Dipole, TotalMeetsThePublishedTable) {
  EXPECT_NEAR(Dipole({2.29, 0.003, 1.3}).total_reflectance(), 0.8464, 5e-5);   // apple R
  EXPECT_NEAR(Dipole({0.74, 0.032, 1.3}).total_reflectance(), 0.4360, 5e-5);   // skin1 R
  EXPECT_NEAR(Dipole({2.62, 0.0041, 1.5}).total_reflectance(), 0.7910, 5e-5);  // marble G
  EXPECT_NEAR(Dipole({0.18, 0.061, 1.3}).total_reflectance(), 0.1638, 5e-5);   // ketchup R
}

TEST(Dipole, DerivativesMeetDifferences) {
  for (const Medium& m : kDipoleMedia) {
    if (m.sigma_a_per_mm == 0.0) continue;  // one-sided there, below
    for (double d : {0.0, 0.1, 0.5, 2.0, 9.0, 30.0}) {
      const Dipole::Value v = Dipole(m).with_derivatives(d);
      Eigen::MatrixXd jacobian(1, 2);
      jacobian << v.d_sigma_s_prime, v.d_sigma_a;
      test_support::expect_derivatives(
          [&](const Eigen::VectorXd& x) {
            return Eigen::VectorXd::Constant(
                1, Dipole({x[0], x[1], m.eta_int_over_ext}).reflectance_per_mm2(d));
          },
          Eigen::Vector2d(m.sigma_s_prime_per_mm, m.sigma_a_per_mm), jacobian, 1e-5);
      EXPECT_DOUBLE_EQ(v.r_per_mm2, Dipole(m).reflectance_per_mm2(d));
    }
  }
}

// The derivative by sigma_a stays finite at sigma_a = 0 and is the limit from above.
TEST(Dipole, DerivativeAtZeroAbsorption) {
  const Dipole none({2.19, 0.0, 1.3});
  for (double d : {0.1, 1.0, 10.0}) {
    const double h = 1e-9;
    const double forward =
        (Dipole({2.19, h, 1.3}).reflectance_per_mm2(d) - none.reflectance_per_mm2(d)) / h;
    EXPECT_NEAR(none.with_derivatives(d).d_sigma_a, forward, 1e-3 * std::abs(forward));
  }
}

// R has the dimension of 1/length^2: a world ten times larger has a hundredth of R.
TEST(Dipole, ScalesWithLength) {
  const double r = Dipole({2.19, 0.002, 1.3}).reflectance_per_mm2(1.7);
  EXPECT_NEAR(Dipole({0.219, 0.0002, 1.3}).reflectance_per_mm2(17.0), r / 100.0, 1e-15 * r);
}

TEST(Dipole, RefusesWhatIsNoMedium) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Medium& m : {Medium{0, 0.1, 1.3}, Medium{-1, 0.1, 1.3}, Medium{1, -0.1, 1.3},
                          Medium{nan, 0.1, 1.3}, Medium{1, nan, 1.3}, Medium{1, 0.1, 0}}) {
    EXPECT_THROW(Dipole{m}, std::invalid_argument);
  }
}

}  // namespace
}  // namespace scattermeter
