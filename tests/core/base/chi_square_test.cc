#include "core/base/chi_square.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// One degree: erfc(sqrt(x/2)). Two: exp(-x/2). Four: (1 + x/2) exp(-x/2).
TEST(ChiSquareTail, MeetsItsClosedForms) {
  for (double x : {0.0, 1e-6, 0.3, 1.0, 2.9, 3.1, 5.9, 6.1, 20.0, 300.0}) {
    EXPECT_NEAR(chi_square_tail(x, 1.0), std::erfc(std::sqrt(0.5 * x)), 1e-13) << x;
    EXPECT_NEAR(chi_square_tail(x, 2.0), std::exp(-0.5 * x), 1e-13) << x;
    EXPECT_NEAR(chi_square_tail(x, 4.0), (1.0 + 0.5 * x) * std::exp(-0.5 * x), 1e-13) << x;
  }
}

// Far from closed forms the tail still falls by its density: dQ/dx = -x^(k/2-1) e^(-x/2) / ...
TEST(ChiSquareTail, FallsByItsDensity) {
  const double dof = 1000.0;
  for (double x : {900.0, 1001.0, 1003.0, 1100.0}) {
    const double h = 1e-2;
    const double slope = (chi_square_tail(x + h, dof) - chi_square_tail(x - h, dof)) / (2.0 * h);
    const double density = std::exp((0.5 * dof - 1.0) * std::log(x) - 0.5 * x -
                                    0.5 * dof * std::log(2.0) - std::lgamma(0.5 * dof));
    EXPECT_NEAR(-slope, density, 1e-6 * density + 1e-11);
  }
  EXPECT_EQ(chi_square_tail(std::numeric_limits<double>::infinity(), 3.0), 0.0);
  EXPECT_THROW(chi_square_tail(-1.0, 3.0), std::invalid_argument);
  EXPECT_THROW(chi_square_tail(1.0, 0.0), std::invalid_argument);
}

TEST(ChiSquareTail, WhatIsNotANumberIsNoFit) {
  EXPECT_EQ(as_chi_square(2.5), 2.5);
  EXPECT_EQ(as_chi_square(-1e-9), 0.0);
  EXPECT_EQ(chi_square_tail(as_chi_square(std::numeric_limits<double>::quiet_NaN()), 3.0), 0.0);
}

}  // namespace
}  // namespace scattermeter
