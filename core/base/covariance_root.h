// What turns independent unit errors into those of a covariance.
#pragma once

#include <Eigen/Core>

namespace scattermeter {

// A square root of a covariance, of its size: covariance = root root^T. Cholesky with pivoting
// holds for one that is singular, too. Domain: symmetric, no negative eigenvalue but for rounding
// (cut at 0).
Eigen::MatrixXd covariance_root(const Eigen::MatrixXd& covariance);

}  // namespace scattermeter
