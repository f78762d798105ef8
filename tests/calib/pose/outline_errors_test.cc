#include "calib/pose/outline_errors.h"

#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/edge_scene.h"

namespace scattermeter::calib {
namespace {

class OutlineErrorsOfACube : public ::testing::Test {
 protected:
  OutlineErrorsOfACube() {
    std::mt19937_64 random(1);
    points_ = outline(RayScene(test_support::make_cube()), small_lens(), cube_view(), 0, 0.0, 0.03,
                      1.0, &random);
    which_.resize(points_.size());
    std::iota(which_.begin(), which_.end(), std::size_t{0});
  }

  std::vector<EdgePoint> points_;
  std::vector<std::size_t> which_;
};

// The covariance is written out point by point, from the definition.
TEST_F(OutlineErrorsOfACube, BecomeIndependentOfUnitVariance) {
  const auto n = static_cast<Eigen::Index>(points_.size());
  for (const double corner_std : {0.0, 0.02, 0.1, 3.0}) {
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index k = 0; k < n; ++k) {
        const EdgePoint& a = points_[static_cast<std::size_t>(i)];
        const EdgePoint& b = points_[static_cast<std::size_t>(k)];
        const auto nearness = [](const EdgePoint& p, std::size_t end) {
          return (p.point_mm - p.line_end_mm[1 - end]).norm() /
                 (p.line_end_mm[1] - p.line_end_mm[0]).norm();
        };
        double shared = 0.0;
        for (const std::size_t x : {std::size_t{0}, std::size_t{1}}) {
          for (const std::size_t y : {std::size_t{0}, std::size_t{1}}) {
            if ((a.line_end_mm[x] - b.line_end_mm[y]).norm() < 1e-9) {
              shared += nearness(a, x) * nearness(b, y);
            }
          }
        }
        covariance(i, k) = corner_std * corner_std * shared * a.outward.dot(b.outward) +
                           (i == k ? 0.03 * 0.03 + 0.04 * 0.04 : 0.0);
      }
    }
    const OutlineErrors errors(points_, which_, corner_std, 0.04);
    const Eigen::MatrixXd of_unit = errors.whitened(errors.whitened(covariance).transpose());
    EXPECT_LT((of_unit - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 1e-8)
        << corner_std;
  }
}

// Lines that meet in a corner share it: six contour edges of a cube have six corners.
TEST_F(OutlineErrorsOfACube, LeaveTheShapeThatCornersMayHaveUnseen) {
  const OutlineErrors errors(points_, which_, 1e4, 0.0);
  const Eigen::MatrixXd whitened = errors.whitened(Eigen::MatrixXd::Identity(
      static_cast<Eigen::Index>(points_.size()), static_cast<Eigen::Index>(points_.size())));
  const Eigen::VectorXd sizes = 0.03 * whitened.colPivHouseholderQr().matrixR().diagonal();
  EXPECT_EQ((sizes.array().abs() < 1e-3).count(), 12);
}

}  // namespace
}  // namespace scattermeter::calib
