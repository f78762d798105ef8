#include "core/base/log_linear_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/dense_solve.h"

namespace scattermeter {
namespace {

struct Cost {
  Eigen::VectorXd residual;
  double chi2, penalty;
  double total() const { return chi2 + penalty; }
};

Cost cost_at(const LogLinearProblem& p, const Eigen::VectorXd& theta) {
  Cost c;
  c.residual = p.kernel * (p.basis * theta).array().exp().matrix() - p.data;
  c.chi2 = c.residual.squaredNorm();
  c.penalty = p.penalty.rows() > 0 ? (p.penalty * theta).squaredNorm() : 0.0;
  return c;
}

}  // namespace

Eigen::MatrixXd log_linear_jacobian(const LogLinearProblem& problem, const Eigen::VectorXd& theta) {
  const Eigen::VectorXd r = (problem.basis * theta).array().exp();
  // Column by column: for so few columns, a matrix product would repack the kernel each time.
  Eigen::MatrixXd out(problem.kernel.rows(), problem.basis.cols());
  for (Eigen::Index j = 0; j < out.cols(); ++j) {
    out.col(j).noalias() = problem.kernel * r.cwiseProduct(problem.basis.col(j));
  }
  return out;
}

LogLinearFit fit_log_linear(const LogLinearProblem& problem, const Eigen::VectorXd& start) {
  constexpr int kIterations = 60;
  constexpr int kHalvings = 12;
  constexpr double kMaxLogStep = 2.0;
  const Eigen::Index n = start.size();
  const Eigen::Index m = problem.kernel.rows();
  LogLinearFit out{start, 0.0, 0.0, false};
  Cost now = cost_at(problem, out.theta);
  for (int k = 0; k < kIterations; ++k) {
    Eigen::MatrixXd jacobian(m + problem.penalty.rows(), n);
    jacobian.topRows(m) = log_linear_jacobian(problem, out.theta);
    jacobian.bottomRows(problem.penalty.rows()) = problem.penalty;
    Eigen::VectorXd residual(jacobian.rows());
    residual << now.residual, problem.penalty * out.theta;
    const Eigen::VectorXd gradient = jacobian.transpose() * residual;
    // Gauss-Newton among the free; parameters that would cross their bounds are moved to the bounds
    // and held there, and the rest is solved for again.
    std::vector<bool> held(static_cast<std::size_t>(n));
    for (Eigen::Index i = 1; i < n; ++i) {
      held[static_cast<std::size_t>(i)] = !(out.theta[i] > 0.0) && !(gradient[i] < 0.0);
    }
    Eigen::VectorXd step = Eigen::VectorXd::Zero(n);
    for (bool crossed = true; crossed;) {
      std::vector<Eigen::Index> free;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (!held[static_cast<std::size_t>(i)]) free.push_back(i);
        if (!held[static_cast<std::size_t>(i)]) step[i] = 0.0;
      }
      const Eigen::VectorXd right = -(residual + jacobian * step);
      step(free) = PivotedSolver(jacobian(Eigen::all, free)).solve(right);
      crossed = false;
      for (Eigen::Index i : free) {
        if (i == 0 || !(out.theta[i] + step[i] < 0.0)) continue;
        step[i] = -out.theta[i];
        held[static_cast<std::size_t>(i)] = true;
        crossed = true;
      }
    }
    if (!step.allFinite()) break;
    const double promised = now.total() - (residual + jacobian * step).squaredNorm();
    if (promised < 1e-6 + 1e-9 * now.total()) {
      out.converged = true;
      break;
    }
    double length =
        std::min(1.0, kMaxLogStep / std::max((problem.basis * step).cwiseAbs().maxCoeff(), 1e-300));
    bool fell = false;
    for (int h = 0; h < kHalvings && !fell; ++h, length *= 0.5) {
      Eigen::VectorXd theta = out.theta + length * step;
      theta.tail(n - 1) = theta.tail(n - 1).cwiseMax(0.0);
      const Cost trial = cost_at(problem, theta);
      if (std::isfinite(trial.total()) && trial.total() < now.total()) {
        fell = true;
        // If the bounds leave almost nothing of the step, the fit has converged.
        out.converged = now.total() - trial.total() < 1e-6 + 1e-9 * now.total();
        out.theta = theta;
        now = trial;
      }
    }
    if (!fell || out.converged) break;
  }
  out.chi2 = now.chi2;
  out.penalty = now.penalty;
  return out;
}

}  // namespace scattermeter
