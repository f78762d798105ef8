#include "calib/pose/edge_fit.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/edge_scene.h"

namespace scattermeter::calib {
namespace {

EdgeFitOptions pose_only(const std::vector<EdgePoint>& points) {
  EdgeFitOptions options;
  options.free = {0, 1, 2, 3, 4, 5};
  options.prior = Eigen::MatrixXd::Zero(edge_parameters(points), edge_parameters(points));
  return options;
}

// Lines whose ends are off and pieces with noise: the answer scatters as it says, without bias.
TEST(EdgeFit, PredictedIsSampled) {
  const RayScene scene(test_support::make_cube());
  const CameraIntrinsics lens = small_lens();
  const Rigid3d pose = cube_view();
  constexpr int kSeeds = 400;
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  Eigen::Matrix<double, 6, 1> squares = sum;
  Eigen::Matrix<double, 6, 1> variance = sum;
  double mahalanobis = 0;
  std::mt19937_64 random(5);
  for (int seed = 0; seed < kSeeds; ++seed) {
    const auto points = outline(scene, lens, pose, 0, 0.1, 0.05, 1, &random);
    EdgeFitOptions options = pose_only(points);
    options.line_std_px = 0.1;
    const EdgeFit f = fit_edges(points, lens, pose, options);
    ASSERT_TRUE(f.converged);
    const Eigen::Matrix<double, 6, 1> e = f.value.head<6>();
    sum += e;
    squares += e.cwiseAbs2();
    variance += f.covariance.diagonal().head<6>();
    mahalanobis += e.dot(f.covariance.topLeftCorner<6, 6>().ldlt().solve(e)) / kSeeds;
  }
  for (int i = 0; i < 6; ++i) {
    const double sampled = std::sqrt(squares[i] / kSeeds - std::pow(sum[i] / kSeeds, 2));
    EXPECT_NEAR(std::sqrt(variance[i] / kSeeds) / sampled, 1, 0.15) << i;
    EXPECT_LT(std::abs(sum[i] / kSeeds), 4.5 * sampled / std::sqrt(kSeeds)) << i;
  }
  // Chi-square of six: 6 +- sqrt(12 / 400), within 4.5 of it.
  EXPECT_NEAR(mahalanobis, 6, 0.8);
}

// Each parameter is found again, with the sign that the header gives it.
TEST(EdgeFit, FindsWhatChanged) {
  using namespace edge_parameter;
  const RayScene scene(test_support::make_cube());
  std::mt19937_64 random(1);
  const Rigid3d pose = cube_view();
  const auto found = [&](const std::vector<int>& free, const CameraIntrinsics& lens,
                         const Rigid3d& true_pose, double scale) {
    const auto points = outline(scene, lens, true_pose, 0, 0, 1e-4, scale, &random);
    EdgeFitOptions options = pose_only(points);
    options.free = free;
    return fit_edges(points, small_lens(), pose, options).value;
  };
  EXPECT_NEAR(found({kScaleOfBody}, small_lens(), pose, 1.02)[kScaleOfBody], std::log(1.02), 1e-4);
  CameraIntrinsics longer = small_lens();
  longer.fx_px *= 1.01;
  longer.fy_px *= 1.01;
  EXPECT_NEAR(found({kFocal}, longer, pose, 1)[kFocal], std::log(1.01), 1e-4);
  const Eigen::Vector3d w(0.01, -0.02, 0.005);
  const Rigid3d turn{Eigen::Quaterniond(Eigen::AngleAxisd(w.norm(), w.normalized())),
                     Eigen::Vector3d::Zero()};
  const Eigen::VectorXd t = found({kTurn, kTurn + 1, kTurn + 2}, small_lens(), turn * pose, 1);
  EXPECT_LT((t.segment<3>(kTurn) - w).norm(), 1e-4);
  const Rigid3d moved{Eigen::Quaterniond::Identity(), {0.3, -0.2, 1}};
  const Eigen::VectorXd m = found({kMove, kMove + 1, kMove + 2}, small_lens(), moved * pose, 1);
  EXPECT_LT((m.segment<3>(kMove) - moved.translation_mm).norm(), 0.02);
}

// A prior whose pivots come in an order that is not its own inverse, and lines that say nothing.
TEST(EdgeFit, KeepsThePriorsCovariance) {
  const RayScene scene(test_support::make_cube());
  std::mt19937_64 random(3);
  const auto points = outline(scene, small_lens(), cube_view(), 0, 0, 0.05, 1, &random);
  EdgeFitOptions options = pose_only(points);
  options.line_std_px = 1e5;
  Eigen::Matrix<double, 6, 6> root = Eigen::Matrix<double, 6, 6>::Zero();
  const double std[] = {4e-4, 1e-4, 2e-4, 3e-3, 2e-3, 2e-2};
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k <= i; ++k) root(i, k) = std[i] * (i == k ? 1 : 0.3 * std::cos(i + 2 * k));
  }
  const Eigen::Matrix<double, 6, 6> covariance = root * root.transpose();
  options.prior.topLeftCorner<6, 6>() = covariance.inverse();
  const EdgeFit f = fit_edges(points, small_lens(), cube_view(), options);
  ASSERT_TRUE(f.converged);
  const Eigen::Matrix<double, 6, 6> found = f.covariance.topLeftCorner<6, 6>();
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(std::sqrt(found(i, i) / covariance(i, i)), 1, 1e-3) << i;
  }
}

TEST(EdgeFit, RefusesNonsense) {
  EXPECT_THROW(fit_edges({}, small_lens(), cube_view(), {}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
