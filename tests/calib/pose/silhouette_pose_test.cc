#include "calib/pose/silhouette_pose.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/edge_scene.h"

namespace scattermeter::calib {
namespace {

// With points that agree: nearer to the truth than they are, and as certain as it claims.
TEST(SilhouettePose, GoesWithAPose) {
  const RayScene scene(test_support::make_cube());
  std::mt19937_64 random(2);
  PoseResult prior;
  prior.status = PoseStatus::kOk;
  prior.covariance.setZero();
  prior.covariance.diagonal().head<3>().setConstant(std::pow(1e-3, 2));
  prior.covariance.diagonal().tail<3>().setConstant(std::pow(0.1, 2));
  const Rigid3d off{Eigen::Quaterniond(Eigen::AngleAxisd(1e-3, Eigen::Vector3d::UnitX())),
                    {0.1, -0.1, 0.1}};
  const Rigid3d truth = cube_view();
  prior.camera_from_world =
      Rigid3d{off.rotation * truth.rotation, truth.translation_mm + off.translation_mm};
  const Silhouette s = find_silhouette(
      {{&scene, 0, picture(scene, small_lens(), truth, 1000, &random)}}, small_lens(), cube_view());
  ASSERT_EQ(s.status, SilhouetteStatus::kOk) << s.message;
  const PoseResult both = combine(s, small_lens(), prior);
  ASSERT_EQ(both.status, PoseStatus::kOk) << both.message;
  const Eigen::Matrix<double, 6, 1> e = pose_error(both.camera_from_world, truth);
  for (int i = 0; i < 6; ++i) {
    EXPECT_LT(both.covariance(i, i), prior.covariance(i, i));
    EXPECT_LT(std::abs(e[i]), 4 * std::sqrt(both.covariance(i, i))) << i;
  }
  EXPECT_LT(both.rms_px, 0.2);
  // Against points that contradict it.
  prior.camera_from_world.translation_mm += Eigen::Vector3d(2, 0, 0);
  EXPECT_EQ(combine(s, small_lens(), prior).status, PoseStatus::kNoConsensus);
}

// An outline made of exact points: the fit is the truth, and its covariance that of the sum of both
// informations, no larger than the prior's.
TEST(SilhouettePose, FitsExactPoints) {
  const RayScene scene(test_support::make_cube());
  std::mt19937_64 random(3);
  Silhouette s;
  s.status = SilhouetteStatus::kOk;
  s.camera_from_world = cube_view();
  s.points = outline(scene, small_lens(), cube_view(), 0, 0.0, 1e-6, 1.0, &random);
  for (EdgePoint& p : s.points) p.std_px = 0.05;
  s.line_std_px = 0.05;
  PoseResult prior;
  prior.status = PoseStatus::kOk;
  prior.covariance.setZero();
  prior.covariance.diagonal().head<3>().setConstant(1e-6);
  prior.covariance.diagonal().tail<3>().setConstant(1e-2);
  prior.camera_from_world = cube_view();
  prior.camera_from_world.translation_mm += Eigen::Vector3d(0.05, -0.03, 0.0);
  const EdgeFit fit = fit_with_pose(s, small_lens(), prior);
  ASSERT_TRUE(fit.converged);
  EXPECT_LT(pose_error(fit.camera_from_world, cube_view()).tail<3>().norm(), 0.05);
  EXPECT_LT(pose_error(fit.camera_from_world, cube_view()).norm(),
            pose_error(prior.camera_from_world, cube_view()).norm());
  const Eigen::Matrix<double, 6, 6> gained =
      prior.covariance - fit.covariance.topLeftCorner<6, 6>();
  for (int i = 0; i < 6; ++i) EXPECT_GT(gained(i, i), 0.0) << i;
  const PoseResult both = combine(s, small_lens(), prior);
  ASSERT_EQ(both.status, PoseStatus::kOk) << both.message;
  EXPECT_TRUE(both.covariance.isApprox(fit.covariance.topLeftCorner<6, 6>(), 1e-12));
  // The centre is known about as well as the translation, turned into the world.
  EXPECT_GT(both.center_std_mm.minCoeff(), 0.0);
}

// Of twenty pieces, those far off where the others stand are strays; where most are off, the pose
// is, and nothing is left out.
TEST(SilhouettePose, StraysStandApart) {
  Silhouette s;
  for (int i = 0; i < 20; ++i) {
    EdgePoint p;
    p.offset_px = i % 2 == 0 ? 0.05 : -0.05;
    p.std_px = 0.05;
    s.points.push_back(p);
  }
  EXPECT_FALSE(without_strays(s).has_value());
  for (const std::size_t i : {3U, 4U, 5U}) s.points[i].offset_px = 1.0;
  const std::optional<Silhouette> others = without_strays(s);
  ASSERT_TRUE(others.has_value());
  EXPECT_EQ(others->points.size(), 17U);
  EXPECT_EQ(others->pieces_left_out, 3U);
  for (const EdgePoint& p : others->points) EXPECT_LT(p.offset_px, 0.1);
  s.points[3].std_px = 0.3;  // one that knows no better
  EXPECT_EQ(without_strays(s)->points.size(), 18U);
  for (const std::size_t i : {6U, 7U, 8U}) s.points[i].offset_px = -1.0;
  EXPECT_FALSE(without_strays(s).has_value());
  for (EdgePoint& p : s.points) p.offset_px = 1.0;
  EXPECT_FALSE(without_strays(s).has_value());
}

}  // namespace
}  // namespace scattermeter::calib
