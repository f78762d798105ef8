#include "core/fit/image_information.h"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

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
  const std::vector<ShotInformation> parts = information_by_shot(SystemRows(s));
  ASSERT_EQ(parts.size(), 3U);
  const ImageInformation sum = joint_information(parts, 3);
  EXPECT_LT((sum.information - whole.information).norm(), 1e-13 * whole.information.norm());
  EXPECT_LT((sum.right - whole.right).norm(), 1e-13 * whole.right.norm());
  EXPECT_NEAR(sum.l2, whole.l2, 1e-12 * whole.l2);
  EXPECT_EQ(sum.rows, whole.rows);
  EXPECT_TRUE(sum.is_sound);
  EXPECT_THROW(joint_information({}, 3), std::invalid_argument);
}

// A shot's information is that of its own system, without the nuisances that don't touch it.
TEST(ImageInformation, OfOneShotIsThatOfItsSystem) {
  const DenseSystem s = three_shots();
  const std::vector<ShotInformation> parts = information_by_shot(SystemRows(s));
  for (std::size_t shot = 0; shot < 3; ++shot) {
    const ImageInformation alone = image_information(shot_of(s, shot));
    const ImageInformation& part = parts[shot].image;
    EXPECT_EQ(part.information.cols(), shot == 1 ? 10 : 9);
    EXPECT_EQ(parts[shot].nuisances, nuisances_of_shot(s, shot));
    ASSERT_EQ(part.information.cols(), alone.information.cols());
    EXPECT_TRUE(part.information.isApprox(alone.information, 1e-13));
    EXPECT_TRUE(part.right.isApprox(alone.right, 1e-13));
    EXPECT_EQ(part.rows, alone.rows);
  }
}

// One number that is none, or a deviation of 0, anywhere.
TEST(ImageInformation, TellsWhatIsNotFinite) {
  const DenseSystem sound = three_shots();
  const auto of_joint = [](const DenseSystem& s) {
    return joint_information(information_by_shot(SystemRows(s)), 3).is_sound;
  };
  EXPECT_TRUE(of_joint(sound));
  DenseSystem s = sound;
  s.std_l[720] = 0.0;
  EXPECT_FALSE(of_joint(s));
  s = sound;
  s.std_l[1199] = -1.0;
  EXPECT_FALSE(image_information(s).is_sound);
  s = sound;
  s.std_l[3] = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(of_joint(s));
  s = sound;
  s.weights(5, 6) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(of_joint(s));
  s = sound;
  s.nuisance_columns(5, 2) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(of_joint(s));
}

}  // namespace
}  // namespace scattermeter
