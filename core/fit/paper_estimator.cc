#include "core/fit/paper_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "core/base/dense_solve.h"
#include "core/fit/residual.h"
#include "core/material/dipole.h"

namespace scattermeter {
namespace {

int steps(double min, double max, double step) {
  return static_cast<int>(std::lround((max - min) / step)) + 1;
}

// Minimum-norm least squares by two orthogonal factorisations: W = Q T, then T's complete
// orthogonal decomposition. The second one works on a square matrix, so the rank decision is cheap.
Eigen::VectorXd pseudo_inverse_times(const WeightMatrix& w, const Eigen::VectorXd& l) {
  const Eigen::Index n = w.cols();
  if (w.rows() <= n) return solve_min_norm(w, l);
  const HouseholderSolver qr(w);
  return solve_min_norm(qr.r(), qr.rotate(l).head(n));
}

std::string on_bound(const char* name, double value, double min, double max, double step) {
  const bool low = value < min + 0.5 * step;
  if (!low && value < max - 0.5 * step) return "";
  std::ostringstream out;
  out << name << " is on the " << (low ? "lower" : "upper") << " bound of the paper's grid, "
      << value << " per mm";
  return out.str();
}

}  // namespace

std::vector<double> paper_widths_mm() {
  std::vector<double> widths;
  for (int i = 1; i <= 10; ++i) widths.push_back(0.05 * i);
  return widths;
}

PaperEstimate solve_paper(const DenseSystem& system, double width_mm, double eta_int_over_ext,
                          const PaperGrid& grid) {
  if (system.l.size() == 0) throw std::invalid_argument("solve_paper: the system has no rows");
  PaperEstimate out;
  out.width_mm = width_mm;
  out.rows = static_cast<std::size_t>(system.l.size());
  out.r = pseudo_inverse_times(system.weights, system.l);
  std::vector<Eigen::Index> knots;
  for (Eigen::Index i = 0; i < out.r.size(); ++i) {
    if (system.weights.col(i).cwiseAbs().maxCoeff() > 0.0) knots.push_back(i);
  }
  out.cost = std::numeric_limits<double>::infinity();
  for (int a = 0; a < steps(grid.sigma_a_min, grid.sigma_a_max, grid.sigma_a_step); ++a) {
    for (int s = 0; s < steps(grid.sigma_s_min, grid.sigma_s_max, grid.sigma_s_step); ++s) {
      const double sigma_s = grid.sigma_s_min + s * grid.sigma_s_step;
      const double sigma_a = grid.sigma_a_min + a * grid.sigma_a_step;
      const Dipole dipole({sigma_s, sigma_a, eta_int_over_ext});
      double cost = 0.0;
      for (Eigen::Index i : knots) {
        const double difference =
            out.r[i] - dipole.reflectance_per_mm2(static_cast<double>(i) * width_mm);
        cost += difference * difference;
        if (cost > out.cost) break;
      }
      if (cost < out.cost) {
        out.cost = cost;
        out.sigma_s_prime_per_mm = sigma_s;
        out.sigma_a_per_mm = sigma_a;
      }
    }
  }
  const Dipole best({out.sigma_s_prime_per_mm, out.sigma_a_per_mm, eta_int_over_ext});
  Eigen::VectorXd r(out.r.size());
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    r[i] = best.reflectance_per_mm2(static_cast<double>(i) * width_mm);
  }
  const Residual rest = residual(system.l, system.weights * r, system.std_l);
  out.psnr_db = rest.psnr_db;
  out.rms_relative = rest.rms_relative;
  out.reduced_chi2 = rest.chi2 / std::max(1.0, static_cast<double>(system.l.size()) - 2.0);
  return out;
}

Estimate choose_width(const std::vector<PaperEstimate>& estimates, const PaperGrid& grid) {
  if (estimates.empty()) throw std::invalid_argument("choose_width: no estimates");
  const PaperEstimate* best = &estimates.front();
  double mean_s = 0, mean_a = 0;
  const double n = static_cast<double>(estimates.size());
  for (const PaperEstimate& a : estimates) {
    if (a.psnr_db > best->psnr_db) best = &a;
    mean_s += a.sigma_s_prime_per_mm / n;
    mean_a += a.sigma_a_per_mm / n;
  }
  double var_s = 0, var_a = 0, cov = 0;
  for (const PaperEstimate& a : estimates) {
    const double ds = a.sigma_s_prime_per_mm - mean_s;
    const double da = a.sigma_a_per_mm - mean_a;
    var_s += ds * ds / std::max(1.0, n - 1.0);
    var_a += da * da / std::max(1.0, n - 1.0);
    cov += ds * da / std::max(1.0, n - 1.0);
  }
  var_s += grid.sigma_s_step * grid.sigma_s_step / 12.0;
  var_a += grid.sigma_a_step * grid.sigma_a_step / 12.0;
  Estimate e;
  e.sigma_s_prime_per_mm = normal_quantity(best->sigma_s_prime_per_mm, std::sqrt(var_s));
  e.sigma_a_per_mm = normal_quantity(best->sigma_a_per_mm, std::sqrt(var_a));
  e.correlation = cov / std::sqrt(var_s * var_a);
  e.scale = {1.0, 0.0, 1.0, 1.0};
  e.reduced_chi2 = best->reduced_chi2;
  e.rms_relative = best->rms_relative;
  e.psnr_db = best->psnr_db;
  e.rows = best->rows;
  e.converged = true;
  for (const std::string& reason : {on_bound("sigma_s'", best->sigma_s_prime_per_mm,
                                             grid.sigma_s_min, grid.sigma_s_max, grid.sigma_s_step),
                                    on_bound("sigma_a", best->sigma_a_per_mm, grid.sigma_a_min,
                                             grid.sigma_a_max, grid.sigma_a_step)}) {
    if (!reason.empty()) e.reasons.push_back(reason);
  }
  return e;
}

}  // namespace scattermeter
