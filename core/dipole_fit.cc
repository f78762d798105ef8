#include "core/dipole_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include <ceres/ceres.h>

#include "core/dipole.h"
#include "core/recovered_reflectance.h"
#include "core/residual.h"

namespace scattermeter {
namespace {

constexpr double kMaxAbsorbed = 0.95;  // of 1 - alpha'

// R and its derivatives on the knots, in u = log sigma_t' and q = 1 - alpha'.
struct Curve {
  Eigen::VectorXd r, d_u, d_q;
};

Medium medium_of(double u, double q, double eta) {
  const double sigma_t = std::exp(u);
  return {(1.0 - q) * sigma_t, q * sigma_t, eta};
}

Curve curve(const DistanceKnots& knots, double u, double q, double eta) {
  const double sigma_t = std::exp(u);
  const Dipole dipole(medium_of(u, q, eta));
  Curve c{Eigen::VectorXd(knots.size()), Eigen::VectorXd(knots.size()),
          Eigen::VectorXd(knots.size())};
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    const Dipole::Value v = dipole.with_derivatives(knots.knots_mm()[static_cast<std::size_t>(i)]);
    c.r[i] = v.r_per_mm2;
    // sigma_s' = (1 - q) sigma_t', sigma_a = q sigma_t', d sigma_t' / du = sigma_t'.
    c.d_u[i] = sigma_t * ((1.0 - q) * v.d_sigma_s_prime + q * v.d_sigma_a);
    c.d_q[i] = sigma_t * (v.d_sigma_a - v.d_sigma_s_prime);
  }
  return c;
}

// Residuals sqrt_information (s R) - whitened; parameter blocks u, q, log s, one value each.
class RecoveredCost final : public ceres::CostFunction {
 public:
  RecoveredCost(const RecoveredReflectance& recovered, const DistanceKnots& knots, double eta)
      : recovered_(recovered), knots_(knots), eta_(eta) {
    set_num_residuals(static_cast<int>(recovered.whitened.size()));
    mutable_parameter_block_sizes()->assign(3, 1);
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const double u = parameters[0][0];
    const double q = parameters[1][0];
    const double s = std::exp(parameters[2][0]);
    if (!std::isfinite(s) || !(std::abs(u) < 300.0) || !(q >= 0.0) || !(q < 1.0)) return false;
    const Curve c = curve(knots_, u, q, eta_);
    const Eigen::Index n = recovered_.whitened.size();
    const Eigen::VectorXd predicted = recovered_.sqrt_information * (s * c.r);
    Eigen::Map<Eigen::VectorXd>(residuals, n) = predicted - recovered_.whitened;
    if (jacobians != nullptr) {
      const auto column = [&](int block) {
        return Eigen::Map<Eigen::VectorXd>(jacobians[block], n);
      };
      if (jacobians[0] != nullptr) column(0) = recovered_.sqrt_information * (s * c.d_u);
      if (jacobians[1] != nullptr) column(1) = recovered_.sqrt_information * (s * c.d_q);
      if (jacobians[2] != nullptr) column(2) = predicted;
    }
    return true;
  }

 private:
  const RecoveredReflectance& recovered_;
  const DistanceKnots& knots_;
  double eta_;
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
};

// Best of a coarse set: mean free paths a factor of two apart, absorbed shares from none to most.
// The scale is solved for where it is not exact.
Parameters start(const RecoveredReflectance& recovered, const DistanceKnots& knots,
                 const DipoleFitOptions& options) {
  Parameters best;
  double best_cost = std::numeric_limits<double>::infinity();
  for (double mfp = knots.resolution_mm(); mfp < 2.0 * knots.max_distance_mm(); mfp *= 2.0) {
    for (double q : {1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.4}) {
      const double u = -std::log(mfp);
      const Eigen::VectorXd p =
          recovered.sqrt_information * curve(knots, u, q, options.eta_int_over_ext).r;
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
        best = {u, q, std::log(s)};
      }
    }
  }
  return best;
}

Quantity quantity(double value, double std) {
  return {value, std, std::max(0.0, value - 1.96 * std), value + 1.96 * std};
}

// Standard deviations and correlation of (sigma_s', sigma_a, s) from the Jacobian at the optimum.
void set_uncertainty(const RecoveredReflectance& recovered, const DistanceKnots& knots,
                     const Parameters& p, const DipoleFitOptions& options, Estimate& estimate) {
  const Curve c = curve(knots, p.u, p.q, options.eta_int_over_ext);
  const double s = std::exp(p.log_s);
  const bool scale_is_exact = options.scale.relative_std == 0.0;
  const Eigen::Index n_parameters = scale_is_exact ? 2 : 3;
  Eigen::MatrixXd jacobian(recovered.whitened.size(), n_parameters);
  jacobian.col(0) = recovered.sqrt_information * (s * c.d_u);
  jacobian.col(1) = recovered.sqrt_information * (s * c.d_q);
  if (!scale_is_exact) jacobian.col(2) = recovered.sqrt_information * (s * c.r);
  Eigen::MatrixXd information = jacobian.transpose() * jacobian;
  if (!scale_is_exact && std::isfinite(options.scale.relative_std)) {
    information(2, 2) += 1.0 / (options.scale.relative_std * options.scale.relative_std);
  }
  // Scaled to a unit diagonal before inverting: the parameters differ by orders of magnitude.
  const Eigen::VectorXd scaling = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scaling.asDiagonal() * information * scaling.asDiagonal();
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(scaled);
  Eigen::MatrixXd covariance =
      ldlt.solve(Eigen::MatrixXd::Identity(n_parameters, n_parameters)).eval();
  covariance = (scaling.asDiagonal() * covariance * scaling.asDiagonal()).eval();
  covariance *= std::max(1.0, estimate.reduced_chi2);
  const double sigma_t = std::exp(p.u);
  Eigen::Matrix2d to_sigma;  // d(sigma_s', sigma_a) / d(u, q)
  to_sigma << (1.0 - p.q) * sigma_t, -sigma_t, p.q * sigma_t, sigma_t;
  const Eigen::Matrix2d cov = to_sigma * covariance.topLeftCorner(2, 2) * to_sigma.transpose();
  const double std_s = std::sqrt(cov(0, 0));
  const double std_a = std::sqrt(cov(1, 1));
  estimate.sigma_s_prime_per_mm = quantity((1.0 - p.q) * sigma_t, std_s);
  estimate.sigma_a_per_mm = quantity(p.q * sigma_t, std_a);
  estimate.correlation = cov(0, 1) / (std_s * std_a);
  estimate.scale = quantity(s, scale_is_exact ? 0.0 : s * std::sqrt(covariance(2, 2)));
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

  ceres::Problem problem;
  problem.AddResidualBlock(new RecoveredCost(recovered, knots, options.eta_int_over_ext), nullptr,
                           &p.u, &p.q, &p.log_s);
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

  const Eigen::VectorXd predicted =
      system.weights * (std::exp(p.log_s) * curve(knots, p.u, p.q, options.eta_int_over_ext).r);
  const Residual rest = residual(system.l, predicted, system.std_l);
  const int n_parameters = options.scale.relative_std == 0.0 ? 2 : 3;
  estimate.reduced_chi2 = rest.chi2 / static_cast<double>(system.l.size() - n_parameters);
  estimate.rms_relative = rest.rms_relative;
  estimate.psnr_db = rest.psnr_db;
  set_uncertainty(recovered, knots, p, options, estimate);
  judge(knots, p, options, estimate);
  return estimate;
}

}  // namespace scattermeter
