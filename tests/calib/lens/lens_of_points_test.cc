#include "calib/lens/lens_of_points.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

constexpr double kNoisePx = 0.15;

// Focal length to 1 %, centre to 50 px, aspect to 0.1 %, k1 to 0.05.
const LensDeviations kWide{0.01, 1e-3, 50.0, 0.05};

CameraIntrinsics drawn(const CameraIntrinsics& stated, const LensRoot& root,
                       std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd z(root.cols());
  for (double& v : z) v = normal(*random);
  return intrinsics_of(lens_parameters(stated) + root * z, stated.width_px, stated.height_px);
}

CameraIntrinsics longer_by(double share) {
  CameraIntrinsics lens = long_lens();
  lens.fx_px *= 1.0 + share;
  lens.fy_px *= 1.0 + share;
  return lens;
}

struct PointsOfLens {
  PoseSource source;
  Rigid3d pose = camera_looking_at({0, 0, 8}, 180, 0.6, 1);

  explicit PointsOfLens(const CameraIntrinsics& lens, std::uint64_t seed = 1) {
    std::mt19937_64 random(seed);
    source.points = shot(lens, pose, slab_points(16, 25, 20, &random), kNoisePx, &random);
    source.options.point_std_px = kNoisePx;
  }
};

Scene scene_with(const LensDeviations& deviations) {
  Scene scene;
  scene.camera.intrinsics = long_lens();
  scene.camera.lens_root = lens_root(scene.camera.intrinsics, deviations);
  return scene;
}

TEST(LensOfPoints, ScattersAsItsCovarianceSays) {
  const CameraIntrinsics stated = long_lens();
  const LensRoot root = lens_root(stated, kWide);
  const Eigen::Index k = root.cols();
  constexpr int kDraws = 200;
  double chi2 = 0.0, p_values = 0.0;
  for (int seed = 0; seed < kDraws; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed) + 100);
    const CameraIntrinsics lens = drawn(stated, root, &random);
    const PointsOfLens points(lens, static_cast<std::uint64_t>(seed));
    PoseOptions options = points.source.options;
    options.inlier_px = 20.0;
    const LensOfPoints found = lens_of_points(stated, root, points.source.points, options);
    ASSERT_EQ(found.pose.status, PoseStatus::kOk) << found.pose.message;
    const Eigen::VectorXd error = lens_parameters(lens) - lens_parameters(found.intrinsics);
    const Eigen::VectorXd unit = root.rowwise().norm().cwiseMax(1e-300).cwiseInverse();
    const Eigen::MatrixXd covariance =
        unit.asDiagonal() * found.root * found.root.transpose() * unit.asDiagonal();
    const Eigen::VectorXd e = unit.cwiseProduct(error);
    chi2 += e.dot(covariance.completeOrthogonalDecomposition().solve(e));
    p_values += found.p_value;
  }
  // A mean of chi-squares of k degrees of freedom, and one of numbers even in [0, 1], to four
  // deviations.
  EXPECT_NEAR(chi2 / kDraws, static_cast<double>(k),
              4.0 * std::sqrt(2.0 * static_cast<double>(k) / kDraws));
  EXPECT_NEAR(p_values / kDraws, 0.5, 4.0 / std::sqrt(12.0 * kDraws));
}

TEST(LensOfPoints, IsTakenWhereTheRigAllowsIt) {
  const PointsOfLens points(longer_by(0.02));
  Scene scene = scene_with(kWide);
  EXPECT_THAT(take_lens_of_points(points.source, scene), HasSubstr("focal length +"));
  const double std_px = scene.camera.lens_root.row(0).norm();
  EXPECT_LT(std_px, 0.5 * 0.01 * long_lens().fx_px);
  EXPECT_NEAR(scene.camera.intrinsics.fx_px, longer_by(0.02).fx_px, 3.0 * std_px);
  EXPECT_LT(estimate_pose(scene.camera.intrinsics, points.source.points, points.source.options)
                .noise_std_px,
            1.5 * kNoisePx);
}

TEST(LensOfPoints, StaysAsStatedWhereThePointsAgree) {
  const PointsOfLens points(long_lens());
  Scene scene = scene_with(kWide);
  EXPECT_EQ(take_lens_of_points(points.source, scene), "");
  EXPECT_EQ(scene.camera.intrinsics.fx_px, long_lens().fx_px);
}

// A mistyped point is left out: that the others agree speaks for the lens.
TEST(LensOfPoints, StaysAsStatedBesideAMistypedPoint) {
  PointsOfLens points(long_lens());
  points.source.points[3].image_px.x() += 15.0;
  Scene scene = scene_with(kWide);
  EXPECT_EQ(take_lens_of_points(points.source, scene), "");
}

// Points of some other layout are no lens at all.
TEST(LensOfPoints, IsNotMadeUpFromPointsOfAnotherLayout) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    PointsOfLens points(long_lens(), seed);
    for (std::size_t i = 0; i < points.source.points.size(); ++i) {
      points.source.points[i].world_mm.x() *= 1.0 + 0.02 * static_cast<double>(i % 5);
      points.source.points[i].world_mm.y() *= 1.3;
    }
    points.source.options.inlier_px = 1000.0;
    Scene scene = scene_with({0.5, 0.5, 1000.0, 5.0});
    EXPECT_NO_THROW(take_lens_of_points(points.source, scene)) << seed;
    scene = scene_with({0.01, 0.001, 50.0, 0.05});
    EXPECT_EQ(take_lens_of_points(points.source, scene), "") << seed;
  }
}

TEST(LensOfPoints, IsNotTakenFarFromWhatTheRigStates) {
  const PointsOfLens points(longer_by(0.03));
  Scene scene = scene_with({0.002, 5e-4, 8.0, 0.01});
  EXPECT_EQ(take_lens_of_points(points.source, scene), "");
  EXPECT_EQ(scene.camera.intrinsics.fx_px, long_lens().fx_px);
}

}  // namespace
}  // namespace scattermeter::calib
