#include "core/base/symmetric_eigen.h"

#include <limits>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

TEST(SymmetricEigen, PutsTheMatrixTogetherAgain) {
  Eigen::Matrix3d m;
  m << 4, 1, -2, 1, 3, 0.5, -2, 0.5, 1;
  const SymmetricEigen e = symmetric_eigen(m);
  EXPECT_LE(e.values[0], e.values[1]);
  EXPECT_LE(e.values[1], e.values[2]);
  EXPECT_TRUE((e.vectors * e.values.asDiagonal() * e.vectors.transpose() - m).isZero(1e-13));
  EXPECT_TRUE((e.vectors.transpose() * e.vectors).isIdentity(1e-13));
}

TEST(SymmetricEigen, HasNoneOfWhatIsNotFinite) {
  Eigen::Matrix2d m = Eigen::Matrix2d::Identity();
  m(1, 0) = std::numeric_limits<double>::quiet_NaN();
  const SymmetricEigen e = symmetric_eigen(m);
  EXPECT_TRUE(e.values.array().isNaN().all());
  EXPECT_TRUE(e.vectors.array().isNaN().all());
}

}  // namespace
}  // namespace scattermeter
