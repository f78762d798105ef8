#include "core/base/covariance_root.h"

#include <Eigen/Cholesky>

namespace scattermeter {

Eigen::MatrixXd covariance_root(const Eigen::MatrixXd& covariance) {
  const Eigen::LDLT<Eigen::MatrixXd> ldlt(covariance);
  Eigen::MatrixXd root = ldlt.matrixL();
  root = ldlt.transpositionsP().transpose() * root;
  return root * ldlt.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

}  // namespace scattermeter
