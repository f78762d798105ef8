#include "core/base/dense_solve.h"

#include <limits>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

Eigen::MatrixXd positive_definite() {
  Eigen::MatrixXd a(3, 3);
  a << 4, 1, -2, 1, 3, 0.5, -2, 0.5, 2;
  return a;
}

// 5 x 3, of full rank.
Eigen::MatrixXd tall() {
  Eigen::MatrixXd a(5, 3);
  a << 1, 2, 0, -1, 0.5, 3, 2, 2, 1, 0, 1, -1, 4, -3, 2;
  return a;
}

TEST(SymmetricSolver, InvertsAPositiveDefiniteMatrix) {
  const Eigen::MatrixXd a = positive_definite();
  const SymmetricSolver solver(a);
  const Eigen::VectorXd b = Eigen::Vector3d(1, -2, 3);
  EXPECT_TRUE((a * solver.solve(b) - b).isZero(1e-13));
  EXPECT_TRUE((a * solver.inverse()).isIdentity(1e-13));
  EXPECT_TRUE((a * solver.solve_columns(tall().topRows(3)) - tall().topRows(3)).isZero(1e-13));
}

TEST(SymmetricSolver, LeavesVanishingPivotsAtZero) {
  const Eigen::MatrixXd a = Eigen::Vector3d(2, 0, 5).asDiagonal();
  const SymmetricSolver solver(a);
  EXPECT_TRUE(solver.solve(Eigen::Vector3d(4, 1, 10)).isApprox(Eigen::Vector3d(2, 0, 2)));
}

TEST(CholeskyLower, IsTheRootOfAPositiveDefiniteMatrixOnly) {
  const Eigen::MatrixXd a = positive_definite();
  const Eigen::MatrixXd lower = cholesky_lower(a);
  EXPECT_TRUE(lower.isLowerTriangular());
  EXPECT_TRUE((lower * lower.transpose() - a).isZero(1e-13));
  EXPECT_TRUE(cholesky_lower(-a).array().isNaN().all());
  const Eigen::MatrixXd none = a * std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(cholesky_lower(none).array().isNaN().all());
}

TEST(HouseholderSolver, FactorsAndRotates) {
  const Eigen::MatrixXd a = tall();
  const HouseholderSolver qr(a);
  EXPECT_TRUE((qr.thin_q().transpose() * qr.thin_q()).isIdentity(1e-13));
  EXPECT_TRUE((qr.thin_q() * qr.r() - a).isZero(1e-13));
  const Eigen::MatrixXd rotated = qr.rotate_columns(a);
  EXPECT_TRUE((rotated.topRows(3) - qr.r()).isZero(1e-13));
  EXPECT_TRUE(rotated.bottomRows(2).isZero(1e-13));
  EXPECT_TRUE((qr.rotate(a.col(2)) - rotated.col(2)).isZero(1e-13));
}

TEST(PivotedSolver, SolvesLeastSquares) {
  const Eigen::MatrixXd a = tall();
  Eigen::VectorXd b(5);
  b << 1, 2, 3, 4, 5;
  const PivotedSolver qr(a);
  EXPECT_EQ(qr.rank(), 3);
  // The normal equations hold at the minimum.
  EXPECT_TRUE((a.transpose() * (a * qr.solve(b) - b)).isZero(1e-12));
  Eigen::MatrixXd columns(5, 2);
  columns << b, -b.reverse();
  EXPECT_TRUE((a.transpose() * (a * qr.solve_columns(columns) - columns)).isZero(1e-12));
  // A P = Q R, so that R (P^T x) are the first entries of Q^T A x.
  const Eigen::VectorXd x = Eigen::Vector3d(1, -2, 0.5);
  const Eigen::VectorXd in_order = qr.unpermute_rows(x);
  EXPECT_TRUE((qr.rotate(a * in_order).head(3) - qr.r() * x).isZero(1e-13));
  EXPECT_TRUE((qr.rotate_columns(a * in_order).topRows(3) - qr.r() * x).isZero(1e-13));
}

// Of two equal equations x + y = 4, the shortest solution, and the pseudo-inverse A^T / |A|^2.
TEST(MinNorm, IsTheShortestSolution) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Ones(2, 2);
  EXPECT_LT((solve_min_norm(a, Eigen::Vector2d(4.0, 4.0)) - Eigen::Vector2d(2.0, 2.0)).norm(),
            1e-14);
  EXPECT_LT((pseudo_inverse(a) - 0.25 * a).norm(), 1e-15);
}

TEST(PivotedSolver, RevealsTheRank) {
  Eigen::MatrixXd a = tall();
  a.col(1) = 2.0 * a.col(0) - a.col(2);
  const PivotedSolver qr(a);
  EXPECT_EQ(qr.rank(), 2);
  const Eigen::VectorXd b = a * Eigen::Vector3d(1, 1, 1);
  EXPECT_TRUE((a * qr.solve(b) - b).isZero(1e-12));
}

TEST(ThinSvd, PutsTheMatrixTogetherAgain) {
  const Eigen::MatrixXd a = tall();
  const ThinSvd svd = thin_svd(a);
  EXPECT_EQ(svd.u.cols(), 3);
  EXPECT_GE(svd.values[0], svd.values[1]);
  EXPECT_GE(svd.values[1], svd.values[2]);
  EXPECT_TRUE((svd.u * svd.values.asDiagonal() * svd.v.transpose() - a).isZero(1e-13));
}

TEST(SolveLu, InvertsAGeneralMatrix) {
  const Eigen::MatrixXd a = tall().topRows(3);
  const Eigen::VectorXd b = Eigen::Vector3d(1, -2, 3);
  EXPECT_TRUE((a * solve_lu(a, b) - b).isZero(1e-13));
  EXPECT_TRUE((a * inverse_lu(a)).isIdentity(1e-13));
}

}  // namespace
}  // namespace scattermeter
