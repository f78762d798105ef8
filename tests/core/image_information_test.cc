#include "core/image_information.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Three shots of different length, with nuisances of which the last touches the second shot alone.
DenseSystem three_shots() {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return normal(random); };
  DenseSystem s{WeightMatrix::NullaryExpr(1200, 7, draw), Eigen::VectorXd::NullaryExpr(1200, draw),
                Eigen::VectorXd::NullaryExpr(1200, [&] { return 0.5 + std::abs(normal(random)); })};
  s.shot_rows = {700, 40, 460};
  s.nuisances = {{"a", 1.0}, {"b", 1.0}, {"c", 1.0}};
  s.nuisance_columns = Eigen::MatrixXd::NullaryExpr(1200, 3, draw);
  s.nuisance_columns.col(2).head(700).setZero();
  s.nuisance_columns.col(2).tail(460).setZero();
  return s;
}

// Against the products as they are defined.
TEST(ImageInformation, IsThatOfTheRows) {
  const DenseSystem s = three_shots();
  Eigen::MatrixXd a(1200, 10);
  a << s.weights, s.nuisance_columns;
  a = (s.std_l.cwiseInverse().asDiagonal() * a).eval();
  const Eigen::VectorXd l = s.l.cwiseQuotient(s.std_l);
  const ImageInformation i = image_information(s);
  EXPECT_LT((i.information - a.transpose() * a).norm(), 1e-12 * (a.transpose() * a).norm());
  EXPECT_LT((i.right - a.transpose() * l).norm(), 1e-12 * (a.transpose() * l).norm());
  EXPECT_NEAR(i.l2, l.squaredNorm(), 1e-12 * l.squaredNorm());
  EXPECT_EQ(i.rows, 1200U);
}

TEST(ImageInformation, OfShotsAddsUp) {
  const DenseSystem s = three_shots();
  const ImageInformation whole = image_information(s);
  const std::vector<ImageInformation> parts = information_by_shot(s);
  ASSERT_EQ(parts.size(), 3U);
  ImageInformation sum = parts[0];
  sum += parts[1];
  sum += parts[2];
  EXPECT_LT((sum.information - whole.information).norm(), 1e-13 * whole.information.norm());
  EXPECT_LT((sum.right - whole.right).norm(), 1e-13 * whole.right.norm());
  EXPECT_NEAR(sum.l2, whole.l2, 1e-12 * whole.l2);
  EXPECT_EQ(sum.rows, whole.rows);
}

// A shot's own system is that of its part, less the nuisances that don't touch it.
TEST(ImageInformation, OfOneShotIsThatOfItsSystem) {
  const DenseSystem s = three_shots();
  const std::vector<ImageInformation> parts = information_by_shot(s);
  for (std::size_t shot = 0; shot < 3; ++shot) {
    const ImageInformation alone = image_information(shot_of(s, shot));
    const ImageInformation part = with_nuisances(parts[shot], 7, nuisances_of_shot(s, shot));
    EXPECT_EQ(part.information.cols(), shot == 1 ? 10 : 9);
    ASSERT_EQ(part.information.cols(), alone.information.cols());
    EXPECT_TRUE(part.information.isApprox(alone.information, 1e-13));
    EXPECT_TRUE(part.right.isApprox(alone.right, 1e-13));
    EXPECT_EQ(part.rows, alone.rows);
  }
}

}  // namespace
}  // namespace scattermeter
