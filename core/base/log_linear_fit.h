// Least-squares fit of a positive curve whose logarithm is linear in its parameters.
#pragma once

#include <Eigen/Core>

namespace scattermeter {

// Minimises |kernel exp(basis theta) - data|^2 + |penalty theta|^2 over theta, with theta_1 .. >= 0
// and theta_0 free. All finite; the penalty may have no rows. Sizes must fit.
struct LogLinearProblem {
  const Eigen::MatrixXd& kernel;
  const Eigen::VectorXd& data;
  Eigen::MatrixXd basis;
  Eigen::MatrixXd penalty;
};

struct LogLinearFit {
  Eigen::VectorXd theta;
  double chi2 = 0;     // |kernel exp(basis theta) - data|^2
  double penalty = 0;  // |penalty theta|^2
  bool converged = false;
};

// Gauss-Newton; parameters that would cross their bound are held there while the others are solved
// for again; those at a bound are released when the gradient points inwards; steps are cut back
// until the cost falls, and none changes log r by more than 2. Converged: the predicted decrease of
// the cost by the next Gauss-Newton step is below 1e-6, or below 1e-9 of the cost. Not converged:
// 60 iterations, or no step lowers the cost. The cost of the result never exceeds that of the
// start.
LogLinearFit fit_log_linear(const LogLinearProblem& problem, const Eigen::VectorXd& start);

// d(kernel exp(basis theta)) / d theta.
Eigen::MatrixXd log_linear_jacobian(const LogLinearProblem& problem, const Eigen::VectorXd& theta);

}  // namespace scattermeter
