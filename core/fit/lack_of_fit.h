// A chi-square test of a model's lack of fit on scales larger than a patch.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// Parts of a surface with about equally many rows each: cut at the median of the widest of x, y, z,
// as long as each part keeps `least` rows, at most `levels` times. Returns the number of each row's
// part, from 0. Domain: levels >= 0, least >= 1 (std::invalid_argument).
std::vector<int> residual_cells(const std::vector<Eigen::Vector3d>& centers_mm, int levels,
                                int least);

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
