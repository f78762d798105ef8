#include "core/fit/lack_of_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"

namespace scattermeter {

LackOfFit lack_of_fit(const Eigen::VectorXd& residual, const Eigen::MatrixXd& covariance,
                      const Eigen::MatrixXd& free, int n_fitted) {
  const Eigen::Index n = residual.size();
  if (covariance.rows() != n || covariance.cols() != n || free.rows() != n) {
    throw std::invalid_argument("lack_of_fit: sizes differ");
  }
  LackOfFit out;
  out.dof = static_cast<double>(n - n_fitted);
  if (!(out.dof > 0.0)) throw std::invalid_argument("lack_of_fit: no cells to spare");
  const Eigen::VectorXd weighed =
      SymmetricSolver(covariance + free * free.transpose()).solve(residual);
  out.chi2 = as_chi_square(residual.dot(weighed));
  out.p_value = chi_square_tail(out.chi2, out.dof);
  // The remainder after the most probable columns, minus the part explained by the covariance.
  const double left = (covariance * weighed).squaredNorm() - covariance.trace();
  out.rms = std::sqrt(std::max(0.0, left / static_cast<double>(n)));
  return out;
}

}  // namespace scattermeter
