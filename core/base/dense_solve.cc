#include "core/base/dense_solve.h"

#include <algorithm>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

namespace scattermeter {

SymmetricSolver::SymmetricSolver(const MatrixRef& a)
    : ldlt_(std::make_shared<const Eigen::LDLT<Eigen::MatrixXd>>(a)) {}

Eigen::VectorXd SymmetricSolver::solve(const VectorRef& b) const { return ldlt_->solve(b); }

Eigen::MatrixXd SymmetricSolver::solve_columns(const MatrixRef& b) const { return ldlt_->solve(b); }

Eigen::MatrixXd SymmetricSolver::inverse() const {
  return solve_columns(Eigen::MatrixXd::Identity(ldlt_->rows(), ldlt_->cols()));
}

Eigen::MatrixXd cholesky_lower(const MatrixRef& a) {
  const Eigen::LLT<Eigen::MatrixXd> llt(a);
  if (llt.info() == Eigen::Success && a.allFinite()) return llt.matrixL();
  return Eigen::MatrixXd::Constant(a.rows(), a.cols(), std::numeric_limits<double>::quiet_NaN());
}

HouseholderSolver::HouseholderSolver(const MatrixRef& a)
    : qr_(std::make_shared<const Eigen::HouseholderQR<Eigen::MatrixXd>>(a)) {}

Eigen::MatrixXd HouseholderSolver::thin_q() const {
  return qr_->householderQ() * Eigen::MatrixXd::Identity(qr_->rows(), qr_->cols());
}

Eigen::MatrixXd HouseholderSolver::r() const {
  return qr_->matrixQR().topRows(qr_->cols()).triangularView<Eigen::Upper>();
}

Eigen::VectorXd HouseholderSolver::rotate(const VectorRef& b) const {
  return qr_->householderQ().adjoint() * b;
}

Eigen::MatrixXd HouseholderSolver::rotate_columns(const MatrixRef& b) const {
  return qr_->householderQ().adjoint() * b;
}

PivotedSolver::PivotedSolver(const MatrixRef& a)
    : qr_(std::make_shared<const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>>(a)) {}

Eigen::Index PivotedSolver::rank() const { return qr_->rank(); }

Eigen::MatrixXd PivotedSolver::r() const {
  return qr_->matrixR().topRows(std::min(qr_->rows(), qr_->cols())).triangularView<Eigen::Upper>();
}

Eigen::VectorXd PivotedSolver::rotate(const VectorRef& b) const {
  return qr_->householderQ().adjoint() * b;
}

Eigen::MatrixXd PivotedSolver::rotate_columns(const MatrixRef& b) const {
  return qr_->householderQ().adjoint() * b;
}

Eigen::MatrixXd PivotedSolver::unpermute_rows(const MatrixRef& b) const {
  return qr_->colsPermutation() * b;
}

Eigen::VectorXd PivotedSolver::solve(const VectorRef& b) const { return qr_->solve(b); }

Eigen::MatrixXd PivotedSolver::solve_columns(const MatrixRef& b) const { return qr_->solve(b); }

Eigen::MatrixXd pseudo_inverse(const MatrixRef& a) {
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(a).pseudoInverse();
}

Eigen::VectorXd solve_min_norm(const MatrixRef& a, const VectorRef& b) {
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(a).solve(b);
}

ThinSvd thin_svd(const MatrixRef& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigen::VectorXd solve_lu(const MatrixRef& a, const VectorRef& b) {
  return Eigen::PartialPivLU<Eigen::MatrixXd>(a).solve(b);
}

Eigen::MatrixXd inverse_lu(const MatrixRef& a) {
  return Eigen::PartialPivLU<Eigen::MatrixXd>(a).inverse();
}

}  // namespace scattermeter
