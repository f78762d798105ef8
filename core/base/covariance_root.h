// The square root of a covariance matrix.
#pragma once

#include <Eigen/Core>

namespace scattermeter {

// A square root of the same size: covariance = root root^T, so that root * (independent unit
// errors) has this covariance. Pivoted Cholesky, which also handles singular matrices. Domain:
// symmetric, no negative eigenvalues apart from rounding (clipped at 0).
Eigen::MatrixXd covariance_root(const Eigen::MatrixXd& covariance);

}  // namespace scattermeter
