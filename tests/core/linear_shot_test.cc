#include "core/linear_shot.h"

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

}  // namespace
}  // namespace scattermeter
