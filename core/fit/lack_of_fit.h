// Whether a model misses what it should show, on a scale larger than a patch.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// Parts of a surface of about as many rows each: cut at the median of the widest of x, y, z, as
// often as that leaves `least` rows in each, at most `levels` times. By row, numbers from 0.
// Domain: levels >= 0, least >= 1 (std::invalid_argument).
std::vector<int> residual_cells(const std::vector<Eigen::Vector3d>& centers_mm, int levels,
                                int least);

// The residual's chi-square under a model of errors that consists of `free` (columns of unit
// standard deviation; wide ones for what the fit has chosen freely) and `covariance`.
struct LackOfFit {
  double chi2 = 0;
  double dof = 0;
  double p_value = 1;  // probability of at least this chi-square where the model holds
  double rms = 0;      // of what neither the columns nor the covariance explain
};
// n_fitted: number of columns of `free` that the fit has chosen. Preconditions
// (std::invalid_argument): sizes agree, more cells than n_fitted.
LackOfFit lack_of_fit(const Eigen::VectorXd& residual, const Eigen::MatrixXd& covariance,
                      const Eigen::MatrixXd& free, int n_fitted);

}  // namespace scattermeter
