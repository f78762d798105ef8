// A chi-square test of a model's lack of fit on scales larger than a patch.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// The residual's chi-square under an error model that consists of `free` (columns of unit standard
// deviation; large ones for freely fitted unknowns) and `covariance`.
struct LackOfFit {
  double chi2 = 0;
  double dof = 0;
  double p_value = 1;  // probability of at least this chi-square where the model holds
  double rms = 0;      // of the part that neither the columns nor the covariance explain
};
// n_fitted: number of columns of `free` for freely fitted unknowns. Preconditions
// (std::invalid_argument): sizes agree, more cells than n_fitted.
LackOfFit lack_of_fit(const Eigen::VectorXd& residual, const Eigen::MatrixXd& covariance,
                      const Eigen::MatrixXd& free, int n_fitted);

}  // namespace scattermeter
