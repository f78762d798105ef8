#include "core/fit/dipole_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include <ceres/ceres.h>

#include "core/base/dense_solve.h"
#include "core/base/solver_options.h"
#include "core/diffusion/dipole_curve.h"
#include "core/fit/dipole_starts.h"

namespace scattermeter {
namespace {

using Coefficient = DipoleSolver::Coefficient;

// Residuals basis^T (sqrt_information (s R, 0) - whitened), all nuisances eliminated; parameter
// blocks u, q, log s, one value each.
class RecoveredCost final : public ceres::SizedCostFunction<ceres::DYNAMIC, 1, 1, 1> {
 public:
  RecoveredCost(const Eigen::MatrixXd& kernel, const Eigen::VectorXd& whitened,
                const DistanceKnots& knots, double eta)
      : kernel_(kernel), whitened_(whitened), knots_(knots), eta_(eta) {
    set_num_residuals(static_cast<int>(whitened.size()));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const double u = parameters[0][0];
    const double q = parameters[1][0];
    const double s = std::exp(parameters[2][0]);
    // Six orders of magnitude below the knots R overflows. Where light goes much farther than the
    // object is large, R fades, and the change of the image by an LED's power, which resembles the
    // image, would stand for all of it.
    const bool far = !(std::exp(-u) > 1e-6 * knots_.resolution_mm()) ||
                     !(std::exp(-u) < knots_.max_distance_mm());
    if (!std::isfinite(s) || far || !(q >= 0.0) || !(q < 1.0)) return false;
    const DipoleCurve c = dipole_curve(knots_, u, q, eta_);
    const Eigen::Index n = whitened_.size();
    const Eigen::VectorXd predicted = kernel_ * (s * c.r);
    Eigen::Map<Eigen::VectorXd> residual_vector(residuals, n);
    residual_vector = predicted - whitened_;
    if (!residual_vector.allFinite()) return false;
    if (jacobians != nullptr) {
      const auto column = [&](int block) {
        return Eigen::Map<Eigen::VectorXd>(jacobians[block], n);
      };
      if (jacobians[0] != nullptr) column(0) = kernel_ * (s * c.d_u);
      if (jacobians[1] != nullptr) column(1) = kernel_ * (s * c.d_q);
      if (jacobians[2] != nullptr) column(2) = predicted;
    }
    return true;
  }

 private:
  const Eigen::MatrixXd& kernel_;
  const Eigen::VectorXd& whitened_;
  const DistanceKnots& knots_;
  double eta_;
};

// The same without q, which follows from u where a coefficient is held: sigma_a = q exp(u), or
// sigma_s' = (1 - q) exp(u).
class HeldCost final : public ceres::SizedCostFunction<ceres::DYNAMIC, 1, 1> {
 public:
  HeldCost(std::unique_ptr<RecoveredCost> cost, Coefficient held, double value_per_mm)
      : cost_(std::move(cost)), held_(held), value_per_mm_(value_per_mm) {
    set_num_residuals(cost_->num_residuals());
  }
  static double q_of(double u, Coefficient held, double value_per_mm) {
    const double share = value_per_mm * std::exp(-u);
    return held == Coefficient::kSigmaA ? share : 1.0 - share;
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    double q = q_of(parameters[0][0], held_, value_per_mm_);
    // On a bound of u, q is beyond its own by rounding.
    constexpr double kRounding = 1e-12;
    if (!(q >= -kRounding) || q > DipoleSolver::kMaxAbsorbed + kRounding) return false;
    q = std::clamp(q, 0.0, DipoleSolver::kMaxAbsorbed);
    const std::array<double const*, 3> all = {parameters[0], &q, parameters[1]};
    if (jacobians == nullptr) return cost_->Evaluate(all.data(), residuals, nullptr);
    std::vector<double> by_q(static_cast<std::size_t>(num_residuals()));
    std::array<double*, 3> d = {jacobians[0], jacobians[0] != nullptr ? by_q.data() : nullptr,
                                jacobians[1]};
    if (!cost_->Evaluate(all.data(), residuals, d.data())) return false;
    if (jacobians[0] != nullptr) {
      const double dq_du = held_ == Coefficient::kSigmaA ? -q : 1.0 - q;
      for (std::size_t i = 0; i < by_q.size(); ++i) jacobians[0][i] += dq_du * by_q[i];
    }
    return true;
  }

 private:
  std::unique_ptr<RecoveredCost> cost_;
  Coefficient held_;
  double value_per_mm_;
};

// (log s) / std: the prior of the scale.
class ScalePriorCost final : public ceres::SizedCostFunction<1, 1> {
 public:
  explicit ScalePriorCost(double relative_std) : inverse_std_(1.0 / relative_std) {}
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    residuals[0] = parameters[0][0] * inverse_std_;
    if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = inverse_std_;
    return true;
  }

 private:
  double inverse_std_;
};

// Whether a search can start there; Ceres would report it on the error stream.
bool can_start(const ceres::CostFunction& cost, const std::vector<double*>& blocks) {
  std::vector<double> residuals(static_cast<std::size_t>(cost.num_residuals()));
  return cost.Evaluate(blocks.data(), residuals.data(), nullptr);
}

// Adds the prior of the scale to a problem that already contains `p`'s log_s, and solves it.
void solve(ceres::Problem& problem, const ScalePrior& scale, DipoleSolver::Point& p) {
  if (scale.relative_std == 0.0) {
    problem.SetParameterBlockConstant(&p.log_s);
  } else if (!scale.is_free()) {
    problem.AddResidualBlock(new ScalePriorCost(scale.relative_std), nullptr, &p.log_s);
  }
  // A search that fails is reported by `converged`, not on the terminal.
  static const int kQuiet = FLAGS_minloglevel = google::GLOG_FATAL;
  static_cast<void>(kQuiet);
  auto solver = quiet_solver<ceres::Solver::Options>({200, 1e-14, 1e-14, 1e-12});
  solver.linear_solver_type = ceres::DENSE_QR;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  p.converged = summary.termination_type == ceres::CONVERGENCE;
  p.cost = 2.0 * summary.final_cost;
}

}  // namespace

DipoleSolver::Point DipoleSolver::Point::of(const Medium& medium, double scale) {
  Point p;
  p.u = std::log(medium.sigma_t_prime_per_mm());
  p.q = medium.sigma_a_per_mm / medium.sigma_t_prime_per_mm();
  p.log_s = std::log(scale);
  return p;
}

double DipoleSolver::Point::sigma_t_prime_per_mm() const { return std::exp(u); }
double DipoleSolver::Point::sigma_s_prime_per_mm() const { return (1.0 - q) * std::exp(u); }
double DipoleSolver::Point::sigma_a_per_mm() const { return q * std::exp(u); }

// With N the nuisances' columns and S their standard deviations, A = (N; 1 / S) is to equal the
// residual (r; 0). The component orthogonal to A's range is the residual that is left, the rest
// determines v; an unbound nuisance without information is in neither.
DipoleSolver::DipoleSolver(const RecoveredReflectance& recovered, const DistanceKnots& knots,
                           const std::vector<Nuisance>& fitted, double eta_int_over_ext,
                           const ScalePrior& scale)
    : knots_(knots), eta_(eta_int_over_ext), scale_(scale) {
  const Eigen::Index n = recovered.whitened.size();
  const auto m = static_cast<Eigen::Index>(fitted.size());
  kernel_ = recovered.sqrt_information.leftCols(knots.size());
  whitened_ = recovered.whitened;
  if (m == 0) return;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n + m, m);
  a.topRows(n) = recovered.sqrt_information.middleCols(knots.size(), m);
  for (Eigen::Index k = 0; k < m; ++k) {
    a(n + k, k) = 1.0 / fitted[static_cast<std::size_t>(k)].std;
  }
  // Units differ: each column is scaled to length 1.
  const Eigen::VectorXd norm = a.colwise().norm();
  const Eigen::VectorXd unit = (norm.array() > 0.0).select(norm.cwiseInverse(), 0.0);
  const PivotedSolver qr(a * unit.asDiagonal());
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n + m, knots.size() + 1);
  columns.topRows(n) << kernel_, whitened_;
  const Eigen::MatrixXd v = unit.asDiagonal() * qr.solve_columns(columns);
  v_by_kernel_ = v.leftCols(knots.size());
  v_by_whitened_ = v.rightCols(1);
  const Eigen::MatrixXd left = qr.rotate_columns(columns).bottomRows(n + m - qr.rank());
  kernel_ = left.leftCols(knots.size());
  whitened_ = left.rightCols(1);
}

DipoleSolver::Point DipoleSolver::best(const std::optional<Point>& near) const {
  Point p;
  p.cost = std::numeric_limits<double>::infinity();
  // A medium that absorbs so much that it reflects less than 2 % is the answer only if there is no
  // other: nuisances far beyond the range in which they are linear can stand for the light it
  // lacks.
  const auto is_black = [](const Point& point) {
    constexpr double kBlack = 0.8;
    return point.q > kBlack;
  };
  std::vector<Point> starts = dipole_starts(kernel_, whitened_, knots_, eta_, scale_);
  if (near) starts.push_back(*near);
  for (const Point& start : starts) {
    const Point q = freed(start);
    const bool better =
        std::isfinite(q.cost) && std::pair(is_black(q), q.cost) < std::pair(is_black(p), p.cost);
    if (better || !std::isfinite(p.cost)) p = q;
  }
  return beside_bound(p);
}

DipoleSolver::Point DipoleSolver::nearest(const Point& from) const {
  return beside_bound(freed(from));
}

DipoleSolver::Point DipoleSolver::beside_bound(Point p) const {
  // Steps that are cut off at q = 0 may end the search early (chi-square 0.3 too high was seen):
  // the optimum on the bound is searched for separately and tested for being one off the bound,
  // too.
  constexpr double kNearBound = 1e-2;
  if (p.q < kNearBound) {
    const std::optional<Point> none = best_with(Coefficient::kSigmaA, 0.0, p);
    if (none && none->cost < p.cost) {
      const Point again = freed(*none);
      p = again.converged && again.cost < none->cost ? again : *none;
    }
  }
  return p;
}

DipoleSolver::Point DipoleSolver::freed(const Point& from) const {
  Point p = from;
  ceres::Problem problem;
  const std::vector<double*> blocks = {&p.u, &p.q, &p.log_s};
  auto cost = std::make_unique<RecoveredCost>(kernel_, whitened_, knots_, eta_);
  if (!can_start(*cost, blocks)) {
    p.converged = false;
    p.cost = std::numeric_limits<double>::infinity();
    return p;
  }
  problem.AddResidualBlock(cost.release(), nullptr, blocks);
  problem.SetParameterLowerBound(&p.q, 0, 0.0);
  problem.SetParameterUpperBound(&p.q, 0, kMaxAbsorbed);
  solve(problem, scale_, p);
  set_nuisances(p);
  return p;
}

void DipoleSolver::set_nuisances(Point& p) const {
  if (v_by_kernel_.rows() == 0) return;
  const Eigen::VectorXd v =
      v_by_whitened_ - v_by_kernel_ * (std::exp(p.log_s) * dipole_curve(knots_, p.u, p.q, eta_).r);
  p.v.assign(v.begin(), v.end());
}

std::optional<DipoleSolver::Point> DipoleSolver::best_with(Coefficient held, double value_per_mm,
                                                           const Point& start) const {
  Point p = start;
  // The nearest u from which the held value can be had.
  if (held == Coefficient::kSigmaA) {
    if (!(value_per_mm >= 0.0)) return std::nullopt;
    if (HeldCost::q_of(p.u, held, value_per_mm) > kMaxAbsorbed) {
      p.u = std::log(value_per_mm / (0.5 * kMaxAbsorbed));
    }
  } else {
    if (!(value_per_mm > 0.0)) return std::nullopt;
    p.u = std::log(value_per_mm / (1.0 - start.q));
  }
  ceres::Problem problem;
  const std::vector<double*> blocks = {&p.u, &p.log_s};
  auto cost = std::make_unique<HeldCost>(
      std::make_unique<RecoveredCost>(kernel_, whitened_, knots_, eta_), held, value_per_mm);
  if (!can_start(*cost, blocks)) return std::nullopt;
  problem.AddResidualBlock(cost.release(), nullptr, blocks);
  // q >= 0 and q <= kMaxAbsorbed as bounds of u.
  if (held == Coefficient::kSigmaA) {
    if (value_per_mm > 0.0) {
      problem.SetParameterLowerBound(&p.u, 0, std::log(value_per_mm / kMaxAbsorbed) + 1e-9);
    }
  } else {
    problem.SetParameterLowerBound(&p.u, 0, std::log(value_per_mm));
    problem.SetParameterUpperBound(&p.u, 0, std::log(value_per_mm / (1.0 - kMaxAbsorbed)) - 1e-9);
  }
  solve(problem, scale_, p);
  p.q = std::clamp(HeldCost::q_of(p.u, held, value_per_mm), 0.0, kMaxAbsorbed);
  if (!p.converged) return std::nullopt;
  set_nuisances(p);
  return p;
}

}  // namespace scattermeter
