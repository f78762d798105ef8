// The uncertainty that estimate_pose() predicts, against the scatter over many noisy shots.
#include <cmath>
#include <string>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "calib/pose/pose.h"
#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

constexpr int kPoseSeeds = 400;

struct UncertainScene {
  std::string name;
  CameraIntrinsics camera;
  Rigid3d pose;
  std::vector<Eigen::Vector3d> points;
  double noise_px;
};

std::vector<UncertainScene> scenes() {
  std::mt19937_64 random(2027);
  const auto plane = slab_points(30, 10, 0, &random);
  const auto volume = slab_points(20, 60, 80, &random);
  std::vector<Eigen::Vector3d> far = cube_points(10);
  for (Eigen::Vector3d& x : far) x += Eigen::Vector3d(400, -300, 100);
  return {
      {"cube", long_lens(), camera_looking_at({0, 0, 0}, 180, 0.6, 1), cube_points(10), 0.3},
      {"plane", long_lens(), camera_looking_at({0, 0, 0}, 180, 0.5, 2), plane, 0.3},
      {"wide", wide_lens(), camera_looking_at({0, 0, 0}, 180, 0.3, 3), volume, 0.5},
      {"origin apart", long_lens(), camera_looking_at({400, -300, 100}, 180, 0.6, 1), far, 0.2}};
}

class PoseUncertainty : public ::testing::TestWithParam<int> {};

TEST_P(PoseUncertainty, PredictedIsSampled) {
  const UncertainScene scene = scenes()[static_cast<size_t>(GetParam())];
  SCOPED_TRACE(scene.name);
  PoseOptions options;
  options.point_std_px = 1e-3;  // so that the residuals alone tell the noise
  options.inlier_px = 6 * scene.noise_px;
  Eigen::Matrix<double, 9, 1> sum = Eigen::Matrix<double, 9, 1>::Zero();
  Eigen::Matrix<double, 9, 1> squares = sum;
  Eigen::Matrix<double, 9, 1> variance = sum;
  double mahalanobis = 0;
  double residual_squares = 0;
  const double freedom = 2.0 * static_cast<double>(scene.points.size()) - 6;
  for (int seed = 0; seed < kPoseSeeds; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed) + 1);
    const PoseResult result = estimate_pose(
        scene.camera, shot(scene.camera, scene.pose, scene.points, scene.noise_px, &random),
        options);
    ASSERT_EQ(result.status, PoseStatus::kOk) << result.message;
    const Eigen::Matrix<double, 6, 1> error = pose_error(result.camera_from_world, scene.pose);
    Eigen::Matrix<double, 9, 1> all;
    all << error,
        inverse(result.camera_from_world).translation_mm - inverse(scene.pose).translation_mm;
    sum += all;
    squares += all.cwiseAbs2();
    variance.head<6>() += result.covariance.diagonal();
    variance.tail<3>() += result.center_std_mm.cwiseAbs2();
    mahalanobis += error.dot(result.covariance.ldlt().solve(error));
    residual_squares += result.rms_px * result.rms_px * static_cast<double>(scene.points.size());
  }
  // w, dt, camera centre: the sampled standard deviation of 400 has one of 3.5 % itself, so 20 %
  // is passed by chance once in 10^7.
  for (int i = 0; i < 9; ++i) {
    const double mean = sum[i] / kPoseSeeds;
    const double sampled = std::sqrt((squares[i] - kPoseSeeds * mean * mean) / (kPoseSeeds - 1));
    const double predicted = std::sqrt(variance[i] / kPoseSeeds);
    EXPECT_NEAR(predicted / sampled, 1, 0.2) << "component " << i;
    // Unbiased: |z| < 4.5 for 36 means in all, level 3e-4 together.
    EXPECT_LT(std::abs(mean), 4.5 * sampled / std::sqrt(kPoseSeeds)) << "component " << i;
  }
  // The noise is found again: within 10 % (the estimate's own standard deviation is below 1 %).
  EXPECT_NEAR(std::sqrt(residual_squares / (kPoseSeeds * freedom)), scene.noise_px,
              0.1 * scene.noise_px);
  // Error^T C^-1 Error / 6 follows F(6, freedom), as the noise is estimated too: mean
  // m / (m - 2), variance 2 m^2 (m + 4) / (6 (m - 2)^2 (m - 4)). The mean of 400 within 4.5
  // standard deviations, level 7e-6 each.
  const double m = freedom;
  const double expected = 6 * m / (m - 2);
  const double spread = 6 * m / (m - 2) * std::sqrt(2 * (m + 4) / (6 * (m - 4)) / kPoseSeeds);
  EXPECT_NEAR(mahalanobis / kPoseSeeds, expected, 4.5 * spread);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PoseUncertainty, ::testing::Range(0, 4));

}  // namespace
}  // namespace scattermeter::calib
