#include "core/base/log_linear_fit.h"

#include <random>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

struct CurveCase {
  Eigen::MatrixXd kernel, basis;
  Eigen::VectorXd data;
  LogLinearProblem problem() const { return {kernel, data, basis, Eigen::MatrixXd(0, 3)}; }
};

// log r = theta_0 - theta_1 x - theta_2 x^2 on x = 0 .. 1, seen through a random positive kernel.
CurveCase seen(const Eigen::Vector3d& truth) {
  CurveCase c;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  c.kernel.resize(30, 20);
  for (double& v : c.kernel.reshaped()) v = 100.0 * uniform(random);
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(20, 0.0, 1.0);
  c.basis.resize(20, 3);
  c.basis << Eigen::VectorXd::Ones(20), (-x).matrix(), (-x.square()).matrix();
  c.data = c.kernel * (c.basis * truth).array().exp().matrix();
  return c;
}

TEST(LogLinearFit, FindsTheTruthFromAfar) {
  const Eigen::Vector3d truth(1.0, 3.0, 0.5);
  const CurveCase c = seen(truth);
  const LogLinearFit fit = fit_log_linear(c.problem(), Eigen::Vector3d(-4.0, 0.1, 6.0));
  EXPECT_TRUE(fit.converged);
  EXPECT_LT(fit.chi2, 1e-5);
  EXPECT_LT((fit.theta - truth).norm(), 1e-3);
}

// The best within the bounds: on the bound the gradient points outwards, elsewhere it vanishes.
TEST(LogLinearFit, StopsAtTheBound) {
  const CurveCase c = seen({1.0, 3.0, -1.0});
  const LogLinearFit fit = fit_log_linear(c.problem(), Eigen::Vector3d(0.0, 1.0, 1.0));
  EXPECT_TRUE(fit.converged);
  EXPECT_EQ(fit.theta[2], 0.0);
  const LogLinearProblem problem = c.problem();
  const Eigen::VectorXd residual = c.kernel * (c.basis * fit.theta).array().exp().matrix() - c.data;
  const Eigen::VectorXd gradient = log_linear_jacobian(problem, fit.theta).transpose() * residual;
  EXPECT_GT(gradient[2], 0.0);
  EXPECT_LT(gradient.head(2).norm(), 1e-3 * gradient[2]);
}

// What nothing tells stays finite.
TEST(LogLinearFit, SurvivesAKernelThatSaysNothing) {
  CurveCase c = seen({1.0, 3.0, 0.5});
  c.kernel.setZero();
  const LogLinearFit fit = fit_log_linear(c.problem(), Eigen::Vector3d(1.0, 1.0, 1.0));
  EXPECT_TRUE(fit.theta.allFinite());
}

}  // namespace
}  // namespace scattermeter
