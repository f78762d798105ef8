#include "core/base/rotation_vector.h"

#include <cmath>

#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>

#include "core/base/cross_matrix.h"

namespace scattermeter {
namespace {

TEST(RotationVector, IsTheExponentialOfTheCrossProduct) {
  for (const double angle : {1e-200, 1e-9, 0.3, 3.0}) {
    const Eigen::Vector3d w = angle * Eigen::Vector3d(2, -1, 2) / 3.0;
    const Eigen::Matrix3d expected = Eigen::Matrix3d(cross_matrix(w)).exp();
    EXPECT_LT((rotation_by(w).toRotationMatrix() - expected).norm(), 1e-14) << angle;
  }
  EXPECT_TRUE(rotation_by(Eigen::Vector3d::Zero()).isApprox(Eigen::Quaterniond::Identity(), 0.0));
}

}  // namespace
}  // namespace scattermeter
