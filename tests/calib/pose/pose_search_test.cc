#include "calib/pose/pose_search.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

TEST(PosesFromThree, OneOfThemIsTheTruth) {
  std::mt19937_64 random(31);
  for (int trial = 0; trial < 200; ++trial) {
    const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.01 * (trial % 100), 0.1 * trial);
    const PoseScene scene = make_scene(
        wide_lens(), shot(wide_lens(), pose, slab_points(3, 30, 30, &random), 0, &random));
    double nearest = 10;
    for (const ScenePose& found : poses_from_three(scene, {0, 1, 2})) {
      nearest = std::min(nearest, pose_error(camera_from_world(scene, found), pose).norm());
    }
    // Two poses of three points can nearly coincide; the quartic's double root then has half of the
    // digits. In rad and mm.
    EXPECT_LT(nearest, 1e-3) << trial;
  }
}

TEST(PosesFromThree, NoneFromALine) {
  std::mt19937_64 random(1);
  const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.4, 1);
  const PoseScene scene = make_scene(
      long_lens(), shot(long_lens(), pose, {{-9, 1, 0}, {0, 1, 0}, {9, 1.001, 0}}, 0, &random));
  EXPECT_TRUE(poses_from_three(scene, {0, 1, 2}).empty());
  EXPECT_TRUE(poses_from_three(scene, {0, 1, 1}).empty());
}

struct Case {
  const char* name;
  CameraIntrinsics camera;
  int pairs;
  int outliers;
  double half_mm;
  double thickness_mm;
};

// As many outliers as may be. An outlier falls within inlier_px of its true place by chance with
// probability pi 2^2 / (3872 x 2592) = 1e-6, and a false pose that explains as many pairs as the
// true one is far rarer still over these trials; so the inliers must be found exactly. Noise of
// 0.3 px passes 2 px with probability exp(-(2 / 0.3)^2 / 2) = 2e-10.
TEST(FindConsensus, FindsTheInliersAmongJustUnderHalfOutliers) {
  const std::vector<Case> cases = {{"volume 6", long_lens(), 6, 2, 10, 20},
                                   {"volume 7", long_lens(), 7, 3, 10, 20},
                                   {"volume 12", long_lens(), 12, 5, 10, 20},
                                   {"plane 30", long_lens(), 30, 14, 10, 0},
                                   {"wide volume 20", wide_lens(), 20, 9, 50, 100},
                                   {"wide plane 100", wide_lens(), 100, 49, 50, 0}};
  for (const Case& c : cases) {
    std::mt19937_64 random(41);
    for (int trial = 0; trial < 25; ++trial) {
      const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.2 + 0.03 * trial, trial);
      const auto points = slab_points(c.pairs, c.half_mm, c.thickness_mm, &random);
      std::vector<PointPair> pairs = shot(c.camera, pose, points, 0.3, &random);
      spoil(c.camera, c.outliers, &pairs, &random);
      const PoseConsensus found = find_consensus(make_scene(c.camera, pairs), 2, 0.9999);
      EXPECT_EQ(found.inliers, c.pairs - c.outliers) << c.name << ", trial " << trial;
      for (int i = 0; i < c.pairs; ++i) {
        EXPECT_EQ(found.inlier[static_cast<size_t>(i)], i >= c.outliers) << c.name << i;
      }
    }
  }
}

TEST(FindConsensus, SameDigitsWhateverOpenCvsRandomState) {
  std::mt19937_64 random(43);
  std::vector<PointPair> pairs = shot(long_lens(), camera_looking_at({0, 0, 0}, 180, 0.6, 1),
                                      slab_points(40, 10, 20, &random), 0.3, &random);
  spoil(long_lens(), 15, &pairs, &random);
  const PoseScene scene = make_scene(long_lens(), pairs);
  const PoseConsensus first = find_consensus(scene, 2, 0.9999);
  cv::setRNGSeed(12345);
  cv::setNumThreads(1);
  const PoseConsensus second = find_consensus(scene, 2, 0.9999);
  cv::setNumThreads(-1);
  EXPECT_EQ(first.inlier, second.inlier);
  EXPECT_EQ(first.fit.pose.rotation, second.fit.pose.rotation);
  EXPECT_EQ(first.fit.pose.center, second.fit.pose.center);
}

TEST(FindConsensus, NothingFromImagePointsWithoutRays) {
  CameraIntrinsics barrel = wide_lens();
  barrel.distortion = {-0.3, 0, 0, 0};
  std::mt19937_64 random(3);
  std::vector<PointPair> pairs =
      shot(barrel, camera_looking_at({0, 0, 0}, 180, 0.6, 1), cube_points(10), 0, &random);
  for (PointPair& pair : pairs) pair.image_px -= Eigen::Vector2d(5000, 0);
  const PoseConsensus found = find_consensus(make_scene(barrel, pairs), 2, 0.9999);
  EXPECT_EQ(found.inliers, 0);
  EXPECT_EQ(std::count(found.inlier.begin(), found.inlier.end(), true), 0);
}

}  // namespace
}  // namespace scattermeter::calib
