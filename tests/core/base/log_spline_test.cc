#include "core/base/log_spline.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/QR>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

const std::vector<double> kBreaks = {-1.0, -0.5, 0.3, 0.6, 1.9, 2.0, 3.0};

Eigen::VectorXd fitted(const LogSpline& spline, const auto& f) {
  Eigen::MatrixXd basis(400, spline.size());
  Eigen::VectorXd value(400);
  for (int i = 0; i < 400; ++i) {
    const double t = -1.0 + 4.0 * i / 399.0;
    basis.row(i) = spline.row(t);
    value[i] = f(t);
  }
  return basis.colPivHouseholderQr().solve(value);
}

// Cubics are in the space, with all their derivatives.
TEST(LogSpline, HoldsCubics) {
  const LogSpline spline(kBreaks);
  ASSERT_EQ(spline.size(), 9);
  const Eigen::VectorXd theta =
      fitted(spline, [](double t) { return 2.0 - t + 0.5 * t * t - 0.25 * t * t * t; });
  for (double t : {-1.0, -0.7, 0.3, 1.0, 1.95, 3.0}) {
    EXPECT_NEAR(spline.row(t) * theta, 2.0 - t + 0.5 * t * t - 0.25 * t * t * t, 1e-12);
    EXPECT_NEAR(spline.row(t, 1) * theta, -1.0 + t - 0.75 * t * t, 1e-11);
    EXPECT_NEAR(spline.row(t, 2) * theta, 1.0 - 1.5 * t, 1e-10);
    EXPECT_NEAR(spline.row(t, 3) * theta, -1.5, 1e-9);
  }
}

// Falls for any non-negative theta_1 ...; a constant is theta_0 alone.
TEST(LogSpline, FallsWhereThetaIsNotNegative) {
  const LogSpline spline(kBreaks);
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(spline.size());
  theta[0] = 4.0;
  EXPECT_NEAR(spline.row(1.234) * theta, 4.0, 1e-15);
  theta.tail(8) << 0.0, 2.0, 0.0, 0.0, 7.0, 0.0, 0.1, 3.0;
  double before = 4.0;
  for (double t = -1.0; t <= 3.0; t += 0.01) {
    const double f = spline.row(t) * theta;
    EXPECT_LE(f, before + 1e-12);
    before = f;
  }
}

// Zero for lines, exactly; for f = t^2/2, f''' - f''/2 = -1/2 and the roughness is
// ∫ exp((t + 1)/2)/4 from -1 to 3 = (e^2 - 1)/2, up to the two-point rule on intervals up to 1.3.
TEST(LogSpline, RoughnessIsTheIntegral) {
  const LogSpline spline(kBreaks);
  const Eigen::MatrixXd q = spline.roughness();
  EXPECT_LT((q * fitted(spline, [](double t) { return 3.0 - 2.0 * t; })).norm(), 1e-10);
  const double rough = (q * fitted(spline, [](double t) { return 0.5 * t * t; })).squaredNorm();
  EXPECT_NEAR(rough, 0.5 * (std::exp(2.0) - 1.0), 1e-4 * rough);
  // For exp(t/2) what is left is the spline's own third derivative, which steps where that of the
  // exponential slopes: half the step, half the error.
  const auto left = [](double step) {
    std::vector<double> breaks;
    for (int i = 0; i * step <= 4.0; ++i) breaks.push_back(i * step - 1.0);
    const LogSpline fine(breaks);
    return (fine.roughness() * fitted(fine, [](double t) { return std::exp(0.5 * t); })).norm();
  };
  EXPECT_NEAR(left(0.25) / left(0.125), 2.0, 0.3);
  EXPECT_LT(left(0.125), 0.1);
}

TEST(LogSpline, RefusesBreaksThatDoNotIncrease) {
  EXPECT_THROW(LogSpline({1.0}), std::invalid_argument);
  EXPECT_THROW(LogSpline({1.0, 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
