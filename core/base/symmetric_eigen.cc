#include "core/base/symmetric_eigen.h"

#include <limits>

#include <Eigen/Eigenvalues>

namespace scattermeter {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& m) {
  if (m.allFinite()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(m);
    if (solver.info() == Eigen::Success) return {solver.eigenvalues(), solver.eigenvectors()};
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {Eigen::VectorXd::Constant(m.rows(), kNone),
          Eigen::MatrixXd::Constant(m.rows(), m.cols(), kNone)};
}

}  // namespace scattermeter
