#include "core/base/covariance_root.h"

#include <gtest/gtest.h>

#include "core/base/cross_matrix.h"

namespace scattermeter {
namespace {

// Of full rank, and of a singular one.
TEST(CovarianceRoot, SquaredIsTheCovariance) {
  Eigen::Matrix3d a;
  a << 2, -1, 0.5, 0.3, 1, -2, 0.7, 0.1, 3;
  for (const Eigen::Matrix3d& c :
       {Eigen::Matrix3d(a * a.transpose()), Eigen::Matrix3d(a.col(0) * a.col(0).transpose()),
        Eigen::Matrix3d(Eigen::Matrix3d::Zero())}) {
    const Eigen::Matrix3d root = covariance_root(c);
    EXPECT_TRUE((root * root.transpose() - c).isZero(1e-12)) << root;
  }
}

TEST(CrossMatrix, IsTheCrossProduct) {
  const Eigen::Vector3d v(1, 2, 3), w(-4, 0.5, 2);
  EXPECT_TRUE((cross_matrix(v) * w - Eigen::Vector3d(2.5, -14, 8.5)).isZero(1e-14));
}

}  // namespace
}  // namespace scattermeter
