#include "core/fit/dipole_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <ceres/ceres.h>

#include "core/base/solver_options.h"
#include "core/diffusion/dipole_curve.h"
#include "core/fit/dipole_starts.h"

namespace scattermeter {
namespace {

using Coefficient = DipoleSolver::Coefficient;

// Residuals sqrt_information (s R, v) - whitened; parameter blocks u, q, log s, one value each, and
// the nuisances v where there are any.
class RecoveredCost final : public ceres::CostFunction {
 public:
  RecoveredCost(const RecoveredReflectance& recovered, const DistanceKnots& knots,
                std::size_t n_nuisances, double eta)
      : kernel_(recovered.sqrt_information.leftCols(knots.size())),
        nuisance_(recovered.sqrt_information.middleCols(knots.size(),
                                                        static_cast<Eigen::Index>(n_nuisances))),
        whitened_(recovered.whitened),
        knots_(knots),
        eta_(eta) {
    set_num_residuals(static_cast<int>(recovered.whitened.size()));
    mutable_parameter_block_sizes()->assign(3, 1);
    if (nuisance_.cols() > 0) {
      mutable_parameter_block_sizes()->push_back(static_cast<int>(nuisance_.cols()));
    }
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const double u = parameters[0][0];
    const double q = parameters[1][0];
    const double s = std::exp(parameters[2][0]);
    // Six orders of magnitude beyond the knots R overflows or vanishes.
    const bool far = !(std::exp(-u) > 1e-6 * knots_.resolution_mm()) ||
                     !(std::exp(-u) < 1e6 * knots_.max_distance_mm());
    if (!std::isfinite(s) || far || !(q >= 0.0) || !(q < 1.0)) return false;
    const DipoleCurve c = dipole_curve(knots_, u, q, eta_);
    const Eigen::Index n = whitened_.size();
    const Eigen::VectorXd predicted = kernel_ * (s * c.r);
    Eigen::Map<Eigen::VectorXd> residual_vector(residuals, n);
    residual_vector = predicted - whitened_;
    if (nuisance_.cols() > 0) {
      residual_vector +=
          nuisance_ * Eigen::Map<const Eigen::VectorXd>(parameters[3], nuisance_.cols());
    }
    if (!residual_vector.allFinite()) return false;
    if (jacobians != nullptr) {
      const auto column = [&](int block) {
        return Eigen::Map<Eigen::VectorXd>(jacobians[block], n);
      };
      if (jacobians[0] != nullptr) column(0) = kernel_ * (s * c.d_u);
      if (jacobians[1] != nullptr) column(1) = kernel_ * (s * c.d_q);
      if (jacobians[2] != nullptr) column(2) = predicted;
      if (nuisance_.cols() > 0 && jacobians[3] != nullptr) {
        Eigen::Map<WeightMatrix>(jacobians[3], n, nuisance_.cols()) = nuisance_;
      }
    }
    return true;
  }

 private:
  Eigen::MatrixXd kernel_;
  Eigen::MatrixXd nuisance_;
  const Eigen::VectorXd& whitened_;
  const DistanceKnots& knots_;
  double eta_;
};

// The same without q, which follows from u where a coefficient is held: sigma_a = q exp(u), or
// sigma_s' = (1 - q) exp(u).
class HeldCost final : public ceres::CostFunction {
 public:
  HeldCost(std::unique_ptr<RecoveredCost> cost, Coefficient held, double value_per_mm)
      : cost_(std::move(cost)), held_(held), value_per_mm_(value_per_mm) {
    set_num_residuals(cost_->num_residuals());
    for (std::size_t i = 0; i < cost_->parameter_block_sizes().size(); ++i) {
      if (i != 1) mutable_parameter_block_sizes()->push_back(cost_->parameter_block_sizes()[i]);
    }
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
    std::vector<double const*> all = {parameters[0], &q};
    for (std::size_t i = 1; i < parameter_block_sizes().size(); ++i) all.push_back(parameters[i]);
    if (jacobians == nullptr) return cost_->Evaluate(all.data(), residuals, nullptr);
    std::vector<double> by_q(static_cast<std::size_t>(num_residuals()));
    std::vector<double*> d = {jacobians[0], jacobians[0] != nullptr ? by_q.data() : nullptr};
    for (std::size_t i = 1; i < parameter_block_sizes().size(); ++i) d.push_back(jacobians[i]);
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

// v / std for every nuisance.
class NuisancePriorCost final : public ceres::CostFunction {
 public:
  explicit NuisancePriorCost(const std::vector<Nuisance>& fitted) : nuisances_(fitted) {
    set_num_residuals(static_cast<int>(fitted.size()));
    mutable_parameter_block_sizes()->assign(1, static_cast<int>(fitted.size()));
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const std::size_t n = nuisances_.size();
    for (std::size_t i = 0; i < n; ++i) residuals[i] = parameters[0][i] / nuisances_[i].std;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      std::fill(jacobians[0], jacobians[0] + n * n, 0.0);
      for (std::size_t i = 0; i < n; ++i) jacobians[0][i * n + i] = 1.0 / nuisances_[i].std;
    }
    return true;
  }

 private:
  const std::vector<Nuisance>& nuisances_;
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

// Adds the priors to a problem that already contains `p`'s log_s and v, and solves it.
void solve(ceres::Problem& problem, const std::vector<Nuisance>& fitted, const ScalePrior& scale,
           DipoleSolver::Point& p) {
  if (!p.v.empty()) {
    problem.AddResidualBlock(new NuisancePriorCost(fitted), nullptr, p.v.data());
  }
  if (scale.relative_std == 0.0) {
    problem.SetParameterBlockConstant(&p.log_s);
  } else if (std::isfinite(scale.relative_std)) {
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

double DipoleSolver::Point::sigma_t_prime_per_mm() const { return std::exp(u); }
double DipoleSolver::Point::sigma_s_prime_per_mm() const { return (1.0 - q) * std::exp(u); }
double DipoleSolver::Point::sigma_a_per_mm() const { return q * std::exp(u); }

DipoleSolver::DipoleSolver(const RecoveredReflectance& recovered, const DistanceKnots& knots,
                           const std::vector<Nuisance>& fitted, double eta_int_over_ext,
                           const ScalePrior& scale)
    : recovered_(recovered),
      knots_(knots),
      fitted_(fitted),
      eta_(eta_int_over_ext),
      scale_(scale) {}

DipoleSolver::Point DipoleSolver::best() const {
  Point p;
  p.cost = std::numeric_limits<double>::infinity();
  for (Point& start : dipole_starts(recovered_, knots_, eta_, scale_)) {
    start.v.assign(fitted_.size(), 0.0);
    const Point q = freed(start);
    if (q.cost < p.cost || !std::isfinite(p.cost)) p = q;
  }
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
  std::vector<double*> blocks = {&p.u, &p.q, &p.log_s};
  if (!p.v.empty()) blocks.push_back(p.v.data());
  auto cost = std::make_unique<RecoveredCost>(recovered_, knots_, fitted_.size(), eta_);
  if (!can_start(*cost, blocks)) {
    p.converged = false;
    p.cost = std::numeric_limits<double>::infinity();
    return p;
  }
  problem.AddResidualBlock(cost.release(), nullptr, blocks);
  problem.SetParameterLowerBound(&p.q, 0, 0.0);
  problem.SetParameterUpperBound(&p.q, 0, kMaxAbsorbed);
  solve(problem, fitted_, scale_, p);
  return p;
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
  std::vector<double*> blocks = {&p.u, &p.log_s};
  if (!p.v.empty()) blocks.push_back(p.v.data());
  auto cost = std::make_unique<HeldCost>(
      std::make_unique<RecoveredCost>(recovered_, knots_, fitted_.size(), eta_), held,
      value_per_mm);
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
  solve(problem, fitted_, scale_, p);
  p.q = std::clamp(HeldCost::q_of(p.u, held, value_per_mm), 0.0, kMaxAbsorbed);
  if (!p.converged) return std::nullopt;
  return p;
}

}  // namespace scattermeter
