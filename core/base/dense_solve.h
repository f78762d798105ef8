// Decompositions of dynamically sized real matrices, compiled once: Eigen's templates add seconds
// to every source that instantiates them. Each class keeps one decomposition; vectors and matrices
// have separate functions because Eigen solves them with different kernels. A right-hand side must
// have as many rows as the matrix (Eigen asserts this in debug builds).
#pragma once

#include <memory>

#include <Eigen/Core>

namespace scattermeter {

using MatrixRef = Eigen::Ref<const Eigen::MatrixXd>;
using VectorRef = Eigen::Ref<const Eigen::VectorXd>;

// LDL^T with pivoting of a symmetric n x n matrix A; reads the lower triangle. Domain: A positive
// or negative semidefinite. Where A is singular, the solution is the one whose components along
// vanishing pivots are 0; where it is indefinite or not finite, the results mean nothing.
class SymmetricSolver {
 public:
  explicit SymmetricSolver(const MatrixRef& a);
  Eigen::VectorXd solve(const VectorRef& b) const;          // x with A x = b
  Eigen::MatrixXd solve_columns(const MatrixRef& b) const;  // X with A X = B, n x any
  Eigen::MatrixXd inverse() const;                          // n x n

 private:
  std::shared_ptr<const Eigen::LDLT<Eigen::MatrixXd>> ldlt_;
};

// Lower triangular L, n x n, with L L^T = A (Cholesky). A is symmetric; its lower triangle is read.
// All NaN where A is not positive definite or not finite.
Eigen::MatrixXd cholesky_lower(const MatrixRef& a);

// Householder QR without pivoting of an m x n matrix A, m >= n.
class HouseholderSolver {
 public:
  explicit HouseholderSolver(const MatrixRef& a);
  Eigen::MatrixXd thin_q() const;                            // m x n, orthonormal columns
  Eigen::MatrixXd r() const;                                 // n x n, upper triangular
  Eigen::VectorXd rotate(const VectorRef& b) const;          // Q^T b, length m
  Eigen::MatrixXd rotate_columns(const MatrixRef& b) const;  // Q^T B, m x any

 private:
  std::shared_ptr<const Eigen::HouseholderQR<Eigen::MatrixXd>> qr_;
};

// Householder QR with column pivoting of an m x n matrix A: A P = Q R, the diagonal of R descending
// in magnitude. It reveals the rank up to Eigen's threshold (epsilon times the smaller dimension).
class PivotedSolver {
 public:
  explicit PivotedSolver(const MatrixRef& a);
  Eigen::Index rank() const;
  Eigen::MatrixXd r() const;                                 // min(m, n) x n, upper triangular
  Eigen::VectorXd rotate(const VectorRef& b) const;          // Q^T b, length m
  Eigen::MatrixXd rotate_columns(const MatrixRef& b) const;  // Q^T B, m x any
  // P B, n x any: rows in the order of R's columns return to the order of A's.
  Eigen::MatrixXd unpermute_rows(const MatrixRef& b) const;
  // Least squares: x that minimises |A x - b|, 0 in the columns beyond the rank.
  Eigen::VectorXd solve(const VectorRef& b) const;
  Eigen::MatrixXd solve_columns(const MatrixRef& b) const;  // n x any

 private:
  std::shared_ptr<const Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> qr_;
};

// By complete orthogonal decomposition, whatever the rank of the m x n matrix A: its
// pseudo-inverse, n x m, and the shortest x that minimises |A x - b|.
Eigen::MatrixXd pseudo_inverse(const MatrixRef& a);
Eigen::VectorXd solve_min_norm(const MatrixRef& a, const VectorRef& b);

// A = U diag(values) V^T, values descending; U is m x k, V is n x k with k = min(m, n). By
// one-sided Jacobi rotations, which keep small singular values accurate relative to the largest.
// Meaningless where A is not finite.
struct ThinSvd {
  Eigen::MatrixXd u;
  Eigen::VectorXd values;
  Eigen::MatrixXd v;
};
ThinSvd thin_svd(const MatrixRef& a);

// Square general A by LU with partial pivoting. Not finite where A is exactly singular.
Eigen::VectorXd solve_lu(const MatrixRef& a, const VectorRef& b);  // x with A x = b
Eigen::MatrixXd inverse_lu(const MatrixRef& a);

}  // namespace scattermeter
