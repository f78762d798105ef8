#include "core/dipole_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <ceres/ceres.h>

#include "core/dipole_curve.h"
#include "core/fit_uncertainty.h"
#include "core/recovered_reflectance.h"
#include "core/residual.h"

namespace scattermeter {
namespace {

constexpr double kMaxAbsorbed = 0.95;  // of 1 - alpha'

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
    if (!std::isfinite(s) || !(std::abs(u) < 300.0) || !(q >= 0.0) || !(q < 1.0)) return false;
    const DipoleCurve c = dipole_curve(knots_, u, q, eta_);
    const Eigen::Index n = whitened_.size();
    const Eigen::VectorXd predicted = kernel_ * (s * c.r);
    Eigen::Map<Eigen::VectorXd> residual_vector(residuals, n);
    residual_vector = predicted - whitened_;
    if (nuisance_.cols() > 0) {
      residual_vector +=
          nuisance_ * Eigen::Map<const Eigen::VectorXd>(parameters[3], nuisance_.cols());
    }
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

// (log s) / std: the rig's word on the scale.
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

struct Parameters {
  double u = 0;
  double q = 0;
  double log_s = 0;
  std::vector<double> nuisance;
};

// Best of a coarse set: mean free paths a factor of two apart, absorbed shares from none to most.
// The scale is solved for where it is not exact.
Parameters start(const RecoveredReflectance& recovered, const DistanceKnots& knots,
                 const DipoleFitOptions& options) {
  Parameters best;
  double best_cost = std::numeric_limits<double>::infinity();
  const int doublings =
      2 + static_cast<int>(std::log2(knots.max_distance_mm() / knots.resolution_mm()));
  for (int k = 0; k < doublings; ++k) {
    const double mfp = std::ldexp(knots.resolution_mm(), k);
    for (double q : {1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.4}) {
      const double u = -std::log(mfp);
      const Eigen::VectorXd p = recovered.sqrt_information.leftCols(knots.size()) *
                                dipole_curve(knots, u, q, options.eta_int_over_ext).r;
      double s = 1.0;
      if (options.scale.relative_std > 0.0) {
        // Weighted by the prior, linear in s.
        const double prior = 1.0 / (options.scale.relative_std * options.scale.relative_std);
        s = (p.dot(recovered.whitened) + prior) / (p.squaredNorm() + prior);
        if (!(s > 0.0)) continue;
      }
      const double cost = (s * p - recovered.whitened).squaredNorm();
      if (cost < best_cost) {
        best_cost = cost;
        best = {u, q, std::log(s), {}};
      }
    }
  }
  return best;
}

void set_uncertainty(const FitUncertainty& fit, const Parameters& p, Estimate& estimate) {
  const Eigen::Matrix2d all = fit.covariance([](const std::string&) { return false; });
  const double sigma_t = std::exp(p.u);
  estimate.sigma_s_prime_per_mm = normal_quantity((1.0 - p.q) * sigma_t, std::sqrt(all(0, 0)));
  estimate.sigma_a_per_mm = normal_quantity(p.q * sigma_t, std::sqrt(all(1, 1)));
  estimate.correlation = all(0, 1) / std::sqrt(all(0, 0) * all(1, 1));
  const double s = std::exp(p.log_s);
  estimate.scale = normal_quantity(s, s * fit.log_scale_std());
  const Eigen::Matrix2d noise = fit.covariance([](const std::string&) { return true; });
  estimate.budget.push_back({"noise", std::sqrt(noise(0, 0)), std::sqrt(noise(1, 1))});
  for (const std::string& cause : fit.causes()) {
    const Eigen::Matrix2d rest = fit.covariance([&](const std::string& c) { return c == cause; });
    estimate.budget.push_back({cause, std::sqrt(std::max(0.0, all(0, 0) - rest(0, 0))),
                               std::sqrt(std::max(0.0, all(1, 1) - rest(1, 1)))});
  }
}

template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream out;
  out.precision(3);
  (out << ... << parts);
  return out.str();
}

void judge(const DistanceKnots& knots, const Parameters& p, const DipoleFitOptions& options,
           Estimate& e) {
  const double mfp_mm = std::exp(-p.u);
  if (!e.converged) e.reasons.push_back("the fit did not converge");
  if (mfp_mm < 2.0 * knots.resolution_mm()) {
    e.reasons.push_back(sentence("the mean free path, ", mfp_mm,
                                 " mm, is too short for the patches: choose a patch size below ",
                                 e.sigma_s_prime_per_mm.value > 0 ? 4.0 * mfp_mm : 0.0, " mm"));
  }
  if (mfp_mm > 0.5 * knots.max_distance_mm()) {
    e.reasons.push_back(
        sentence("the mean free path, ", mfp_mm,
                 " mm, is not small against the object: the dipole does not apply"));
  }
  if (p.q > 0.7) {
    e.reasons.push_back(sentence("the albedo alpha' = ", 1.0 - p.q,
                                 " is too low for the dipole, which wants it near 1"));
  }
  const double relative_std = e.sigma_s_prime_per_mm.std / e.sigma_s_prime_per_mm.value;
  if (!std::isfinite(relative_std) || relative_std > options.max_relative_std_sigma_s) {
    e.reasons.push_back(
        "these shots do not determine sigma_s' (no absolute scale and no light edge "
        "on the object, or too little light)");
  }
  if (e.reduced_chi2 > options.max_reduced_chi2 && e.rms_relative > options.max_rms_relative) {
    e.reasons.push_back(sentence("the dipole does not explain the shots: residual ",
                                 100.0 * e.rms_relative, " %, reduced chi-square ",
                                 e.reduced_chi2));
  }
}

}  // namespace

void DipoleFitOptions::Check() const {
  if (!(eta_int_over_ext > 0.0)) throw std::invalid_argument("DipoleFitOptions.eta_int_over_ext");
  if (!(scale.relative_std >= 0.0)) throw std::invalid_argument("DipoleFitOptions.scale");
}

Estimate fit_dipole(const DenseSystem& system, const DistanceKnots& knots,
                    const DipoleFitOptions& options) {
  options.Check();
  Estimate estimate;
  estimate.rows = static_cast<std::size_t>(system.l.size());
  if (estimate.rows < options.min_rows) {
    estimate.reasons.push_back(sentence("only ", estimate.rows, " patches can be used, at least ",
                                        options.min_rows, " are needed"));
    return estimate;
  }
  const RecoveredReflectance recovered = recover_reflectance(system);
  if (recovered.whitened.size() < 3) {
    estimate.reasons.push_back("no light reaches the object in these shots");
    return estimate;
  }
  Parameters p = start(recovered, knots, options);
  std::vector<Nuisance> fitted;
  std::copy_if(system.nuisances.begin(), system.nuisances.end(), std::back_inserter(fitted),
               [](const Nuisance& n) { return n.fitted; });
  p.nuisance.assign(fitted.size(), 0.0);

  ceres::Problem problem;
  std::vector<double*> blocks = {&p.u, &p.q, &p.log_s};
  if (!p.nuisance.empty()) {
    blocks.push_back(p.nuisance.data());
    problem.AddResidualBlock(new NuisancePriorCost(fitted), nullptr, p.nuisance.data());
  }
  problem.AddResidualBlock(
      new RecoveredCost(recovered, knots, fitted.size(), options.eta_int_over_ext), nullptr,
      blocks);
  if (options.scale.relative_std == 0.0) {
    problem.SetParameterBlockConstant(&p.log_s);
  } else if (std::isfinite(options.scale.relative_std)) {
    problem.AddResidualBlock(new ScalePriorCost(options.scale.relative_std), nullptr, &p.log_s);
  }
  problem.SetParameterLowerBound(&p.q, 0, 0.0);
  problem.SetParameterUpperBound(&p.q, 0, kMaxAbsorbed);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 200;
  solver.function_tolerance = 1e-14;
  solver.gradient_tolerance = 1e-14;
  solver.parameter_tolerance = 1e-12;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  estimate.converged = summary.termination_type == ceres::CONVERGENCE;

  Eigen::VectorXd predicted =
      system.weights *
      (std::exp(p.log_s) * dipole_curve(knots, p.u, p.q, options.eta_int_over_ext).r);
  if (!p.nuisance.empty()) {
    const auto n = static_cast<Eigen::Index>(fitted.size());
    predicted += system.nuisance_columns.leftCols(n) *
                 Eigen::Map<const Eigen::VectorXd>(p.nuisance.data(), n);
  }
  const Residual rest = residual(system.l, predicted, system.std_l);
  const int n_parameters = options.scale.relative_std == 0.0 ? 2 : 3;
  estimate.reduced_chi2 = rest.chi2 / static_cast<double>(system.l.size() - n_parameters);
  estimate.rms_relative = rest.rms_relative;
  estimate.psnr_db = rest.psnr_db;
  set_uncertainty(
      FitUncertainty(recovered, system.nuisances,
                     dipole_curve(knots, p.u, p.q, options.eta_int_over_ext), p.u, p.q,
                     std::exp(p.log_s), options.scale, std::max(1.0, estimate.reduced_chi2)),
      p, estimate);
  judge(knots, p, options, estimate);
  return estimate;
}

}  // namespace scattermeter
