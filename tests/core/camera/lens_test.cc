#include "core/camera/lens.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/pose_scenes.h"
#include "tests/fixtures/core/derivative_check.h"

namespace scattermeter {
namespace {

TEST(Lens, JacobianMatchesCentralDifferences) {
  for (const CameraIntrinsics& intrinsics : {calib::long_lens(), calib::wide_lens()}) {
    const Lens lens(intrinsics);
    const Eigen::Vector3d x(-31, 22, 140);
    Eigen::Matrix<double, 2, 3> jacobian;
    lens.project(x, &jacobian);
    test_support::expect_derivatives(
        [&](const Eigen::VectorXd& v) -> Eigen::VectorXd { return lens.project(v.head<3>()); }, x,
        jacobian, 1e-8);
  }
}

TEST(Lens, PixelIsTheSameAlongARay) {
  const Lens lens(calib::wide_lens());
  const Eigen::Vector3d x(0.3, -0.2, 1);
  EXPECT_LT((lens.project(x) - lens.project(1e6 * x)).norm(), 1e-9);
}

TEST(Lens, UnprojectReturnsToThePixelFromAnyGuess) {
  const Lens lens(calib::wide_lens());
  const Eigen::Vector2d corner(0, 2591);
  for (const Eigen::Vector2d& guess : {Eigen::Vector2d(0, 0), Eigen::Vector2d(9, 9)}) {
    const Eigen::Vector2d ray = lens.unproject(corner, guess);
    EXPECT_LT((lens.project({ray.x(), ray.y(), 1}) - corner).norm(), 2e-9);
  }
}

TEST(Lens, RefusesBadIntrinsics) {
  CameraIntrinsics intrinsics = calib::long_lens();
  intrinsics.fx_px = -1;
  EXPECT_THROW(Lens{intrinsics}, std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
