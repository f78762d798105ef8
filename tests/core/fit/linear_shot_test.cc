#include "core/fit/linear_shot.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Rows of two shots and two lights; a row that is not used holds absurd numbers.
TEST(LinearShot, StacksUsedRowsOnly) {
  WeightMatrix a(3, 2), b(3, 2), c(1, 2);
  a << 1, 2, 3, 4, 5, 6;
  b << 10, 20, 30, 40, 50, 60;
  c << 7, 8;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ChannelObservation one;
  one.l = {1.0, nan, 3.0};
  one.variance = {4.0, nan, 9.0};
  one.state = {RowState::kUsed, RowState::kClipped, RowState::kUsed};
  one.rows_used = 2;
  ChannelObservation two;
  two.l = {5.0};
  two.variance = {16.0};
  two.state = {RowState::kUsed};
  two.rows_used = 1;
  const DenseSystem s = stack({{{{&a, 2.0}, {&b, 0.5}}, &one}, {{{&c, 3.0}}, &two}});
  ASSERT_EQ(s.weights.rows(), 3);
  EXPECT_EQ(s.weights(0, 0), 2.0 * 1 + 0.5 * 10);
  EXPECT_EQ(s.weights(1, 1), 2.0 * 6 + 0.5 * 60);
  EXPECT_EQ(s.weights(2, 0), 21.0);
  EXPECT_EQ(s.l, Eigen::Vector3d(1, 3, 5));
  EXPECT_EQ(s.std_l, Eigen::Vector3d(2, 3, 4));
  EXPECT_DOUBLE_EQ(stack({{{{&c, 3.0}}, &two, 0.6}}).std_l[0], 5.0);  // hypot(4, 0.6 * 5)
  WeightMatrix other(1, 3);
  EXPECT_THROW(stack({{{{&a, 1.0}}, &one}, {{{&other, 1.0}}, &two}}), std::invalid_argument);
}

// Some rows, from several shots.
TEST(LinearShot, SomeRowsOfASystem) {
  DenseSystem s{WeightMatrix(4, 1), Eigen::VectorXd(4), Eigen::VectorXd(4)};
  s.weights << 1, 2, 3, 4;
  s.l << 10, 20, 30, 40;
  s.std_l << 5, 6, 7, 8;
  s.shot_rows = {1, 1, 2};
  s.nuisances = {{"one", 0.1, true}};
  s.nuisance_columns.resize(4, 1);
  s.nuisance_columns << 1, 0, 0, 2;
  s.beyond_column = {0, Eigen::Vector4d(9, 8, 7, 6)};
  const DenseSystem some = selected(s, {0, 2, 3});
  EXPECT_EQ(some.weights, Eigen::Vector3d(1, 3, 4));
  EXPECT_EQ(some.l, Eigen::Vector3d(10, 30, 40));
  EXPECT_EQ(some.std_l, Eigen::Vector3d(5, 7, 8));
  EXPECT_EQ(some.shot_rows, (std::vector<Eigen::Index>{1, 0, 2}));
  EXPECT_EQ(some.nuisance_columns, Eigen::Vector3d(1, 0, 2));
  EXPECT_EQ(some.beyond_column.nuisance, 0);
  EXPECT_EQ(some.beyond_column.l, Eigen::Vector3d(9, 7, 6));
  EXPECT_EQ(selected(s, {}).shot_rows, (std::vector<Eigen::Index>{0, 0, 0}));
}

// The rows of one shot, with the nuisances that move any of them and no others.
TEST(LinearShot, OneShotOfASystem) {
  DenseSystem s{WeightMatrix(5, 2), Eigen::VectorXd(5), Eigen::VectorXd(5)};
  s.weights << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10;
  s.l << 1, 2, 3, 4, 5;
  s.std_l << 10, 20, 30, 40, 50;
  s.shot_rows = {2, 0, 3};
  s.nuisances = {{"first only", 0.1, true}, {"both", 0.2, true}, {"last only", 0.3, false}};
  s.nuisance_columns.resize(5, 3);
  s.nuisance_columns << 1, 2, 0, 0, 3, 0, 0, 4, 5, 0, 6, 0, 0, 7, 8;
  const DenseSystem first = shot_of(s, 0);
  EXPECT_EQ(first.weights, s.weights.topRows(2));
  EXPECT_EQ(first.l, s.l.head(2));
  EXPECT_EQ(first.std_l, s.std_l.head(2));
  EXPECT_EQ(first.shot_rows, std::vector<Eigen::Index>{2});
  ASSERT_EQ(first.nuisances.size(), 2U);
  EXPECT_EQ(first.nuisances[0].group, "first only");
  EXPECT_EQ(first.nuisances[1].group, "both");
  EXPECT_EQ(first.nuisance_columns, s.nuisance_columns.topLeftCorner(2, 2));
  const DenseSystem last = shot_of(s, 2);
  EXPECT_EQ(last.l, s.l.tail(3));
  ASSERT_EQ(last.nuisances.size(), 2U);
  EXPECT_EQ(last.nuisances[0].std, 0.2);
  EXPECT_FALSE(last.nuisances[1].fitted);
  EXPECT_EQ(last.nuisance_columns, s.nuisance_columns.bottomRightCorner(3, 2));
  const DenseSystem none = shot_of(s, 1);
  EXPECT_EQ(none.l.size(), 0);
  EXPECT_TRUE(none.nuisances.empty());
  EXPECT_THROW(shot_of(s, 3), std::out_of_range);
  s.nuisances.clear();
  s.nuisance_columns.resize(0, 0);
  EXPECT_EQ(shot_of(s, 2).l, s.l.tail(3));
  EXPECT_EQ(shot_of(s, 2).nuisance_columns.cols(), 0);
}

}  // namespace
}  // namespace scattermeter
