#include "core/symmetric_eigen.h"

#include <stdexcept>

#include <Eigen/Eigenvalues>

namespace scattermeter {

SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& m) {
  if (!m.allFinite()) throw std::domain_error("symmetric_eigen: not finite");
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(m);
  if (solver.info() != Eigen::Success) throw std::domain_error("symmetric_eigen: no convergence");
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace scattermeter
