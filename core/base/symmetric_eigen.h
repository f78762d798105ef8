// Eigenvalues of symmetric matrices of any size, compiled once.
#pragma once

#include <Eigen/Core>

namespace scattermeter {

struct SymmetricEigen {
  Eigen::VectorXd values;   // ascending
  Eigen::MatrixXd vectors;  // unit eigenvectors, one per column
};

// Reads the lower triangle. All NaN where m is not finite, or the iteration does not converge.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& m);

}  // namespace scattermeter
