// What turns independent unit errors into those of a covariance.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace scattermeter {

// A square root of a covariance: covariance = root root^T. Cholesky with pivoting holds for one
// that is singular, too. Domain: symmetric, no negative eigenvalue but for rounding (cut at 0).
template <typename Matrix>
Matrix covariance_root(const Matrix& covariance) {
  const Eigen::LDLT<Matrix> ldlt(covariance);
  Matrix root = ldlt.matrixL();
  root = ldlt.transpositionsP().transpose() * root;
  return (root * ldlt.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal()).eval();
}

}  // namespace scattermeter
