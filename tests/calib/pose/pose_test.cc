#include "calib/pose/pose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

PoseResult estimate(const std::vector<Eigen::Vector3d>& points, double distance_mm, double tilt_rad,
                    double noise_px = 0.3) {
  std::mt19937_64 random(61);
  const Rigid3d pose = camera_looking_at({0, 0, 0}, distance_mm, tilt_rad, 0.8);
  return estimate_pose(long_lens(), shot(long_lens(), pose, points, noise_px, &random));
}

void expect_no_pose(const PoseResult& result) {
  EXPECT_FALSE(result.message.empty());
  EXPECT_TRUE(std::isnan(result.camera_from_world.translation_mm.x()));
  EXPECT_TRUE(std::isnan(result.camera_from_world.rotation.w()));
  EXPECT_TRUE(result.covariance.array().isNaN().all());
  EXPECT_EQ(std::count(result.inlier.begin(), result.inlier.end(), true), 0);
}

TEST(EstimatePose, ExactPairsGiveTheExactPose) {
  for (const CameraIntrinsics& camera : {long_lens(), wide_lens()}) {
    std::mt19937_64 random(1);
    const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.7, 2);
    const PoseResult result =
        estimate_pose(camera, shot(camera, pose, cube_points(10), 0, &random));
    EXPECT_EQ(result.status, PoseStatus::kOk);
    EXPECT_EQ(result.message, "");
    const Eigen::Matrix<double, 6, 1> error = pose_error(result.camera_from_world, pose);
    EXPECT_LT(error.head<3>().norm(), 1e-10);
    EXPECT_LT(error.tail<3>().norm(), 1e-8);
    EXPECT_LT(result.rms_px, 1e-8);
    EXPECT_EQ(result.noise_std_px, 0.3);  // not the residuals', which tell nothing here
  }
}

TEST(EstimatePose, GoodLayoutsAreNotFlagged) {
  for (int seed = 0; seed < 40; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.35 + 0.015 * seed, seed);
    for (const auto& points :
         {square_points(10), cube_points(10), slab_points(30, 10, 0, &random)}) {
      const PoseResult result =
          estimate_pose(long_lens(), shot(long_lens(), pose, points, 0.3, &random));
      EXPECT_EQ(result.status, PoseStatus::kOk) << result.message << points.size() << " " << seed;
    }
  }
}

TEST(EstimatePose, OutliersAreRejectedAndTheirResidualsTold) {
  std::mt19937_64 random(71);
  const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.5, 1);
  std::vector<PointPair> pairs = shot(long_lens(), pose, cube_points(10), 0.3, &random);
  pairs[2].image_px += Eigen::Vector2d(30, -40);
  pairs[9].image_px += Eigen::Vector2d(-5, 0);
  const PoseResult result = estimate_pose(long_lens(), pairs);
  ASSERT_EQ(result.status, PoseStatus::kOk) << result.message;
  for (size_t i = 0; i < 12; ++i) EXPECT_EQ(result.inlier[i], i != 2 && i != 9) << i;
  // Projected minus given; the pose itself moves images by well below 1 px.
  EXPECT_LT((result.residuals_px[2] - Eigen::Vector2d(-30, 40)).norm(), 2);
  EXPECT_LT(result.worst_px, 2);
  double sum = 0;
  double worst = 0;
  for (size_t i = 0; i < 12; ++i) {
    if (!result.inlier[i]) continue;
    sum += result.residuals_px[i].squaredNorm();
    worst = std::max(worst, result.residuals_px[i].norm());
  }
  EXPECT_NEAR(result.rms_px, std::sqrt(sum / 10), 1e-9);
  EXPECT_NEAR(result.worst_px, worst, 1e-9);
}

// A world origin a kilometre away: 1e6 mm are held to 1e-10 mm, so nothing but rounding changes.
TEST(EstimatePose, TheWorldsOriginDoesNotMatter) {
  const Eigen::Vector3d offset(1e6, -4e5, 7e5);
  std::mt19937_64 random(73);
  const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.5, 1);
  const std::vector<PointPair> near = shot(long_lens(), pose, cube_points(10), 0.3, &random);
  std::vector<PointPair> far = near;
  for (PointPair& pair : far) pair.world_mm += offset;
  const PoseResult at_origin = estimate_pose(long_lens(), near);
  const PoseResult away = estimate_pose(long_lens(), far);
  ASSERT_EQ(away.status, PoseStatus::kOk) << away.message;
  const Rigid3d near_again = {
      away.camera_from_world.rotation,
      away.camera_from_world.translation_mm + away.camera_from_world.rotation * offset};
  const Eigen::Matrix<double, 6, 1> error = pose_error(near_again, at_origin.camera_from_world);
  EXPECT_LT(error.head<3>().norm(), 1e-9);
  // The rotation's last digit (1e-16) at a lever of 1e6 mm.
  EXPECT_LT(error.tail<3>().norm(), 1e-6);
  EXPECT_LT((away.center_std_mm - at_origin.center_std_mm).norm(),
            1e-6 * at_origin.center_std_mm.norm());
  // dt at the far origin is dt at the near one + the lever's swing: Var = A C A^T.
  const Eigen::Vector3d lever = away.camera_from_world.rotation * -offset;
  Eigen::Matrix<double, 6, 6> swing = Eigen::Matrix<double, 6, 6>::Identity();
  swing.block<3, 3>(3, 0) << 0, lever.z(), -lever.y(), -lever.z(), 0, lever.x(), lever.y(),
      -lever.x(), 0;
  const Eigen::Matrix<double, 6, 6> expected = swing * at_origin.covariance * swing.transpose();
  EXPECT_LT((away.covariance - expected).norm(), 1e-6 * expected.norm());
}

TEST(EstimatePose, AThousandTimesLargerIsTheSameRotation) {
  std::mt19937_64 random(79);
  const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.5, 1);
  const std::vector<PointPair> small = shot(long_lens(), pose, cube_points(10), 0.3, &random);
  for (const double factor : {1e-3, 1e3}) {
    std::vector<PointPair> large = small;
    for (PointPair& pair : large) pair.world_mm *= factor;
    const PoseResult one = estimate_pose(long_lens(), small);
    const PoseResult other = estimate_pose(long_lens(), large);
    ASSERT_EQ(other.status, PoseStatus::kOk) << other.message;
    EXPECT_LT(other.camera_from_world.rotation.angularDistance(one.camera_from_world.rotation),
              1e-9);
    EXPECT_LT(
        (other.camera_from_world.translation_mm / factor - one.camera_from_world.translation_mm)
            .norm(),
        1e-6);
    EXPECT_LT((other.center_std_mm / factor - one.center_std_mm).norm(),
              1e-6 * one.center_std_mm.norm());
  }
}

TEST(EstimatePose, TooFewPoints) {
  EXPECT_EQ(estimate({}, 180, 0.5).status, PoseStatus::kTooFewPoints);
  const PoseResult three = estimate({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}, 180, 0.5);
  EXPECT_EQ(three.status, PoseStatus::kTooFewPoints);
  EXPECT_EQ(three.inlier.size(), 3U);
  expect_no_pose(three);
  const PoseResult twice = estimate({{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {9, 0, 0}}, 180, 0.5);
  EXPECT_EQ(twice.status, PoseStatus::kTooFewPoints);
  EXPECT_THAT(twice.message, HasSubstr("3 different positions"));
}

TEST(EstimatePose, AWrongPairAmongFourIsNoticed) {
  std::mt19937_64 random(83);
  std::vector<PointPair> pairs =
      shot(long_lens(), camera_looking_at({0, 0, 0}, 180, 0.5, 1), square_points(10), 0.3, &random);
  pairs[1].image_px += Eigen::Vector2d(80, -90);
  const PoseResult result = estimate_pose(long_lens(), pairs);
  EXPECT_EQ(result.status, PoseStatus::kTooFewPoints);
  EXPECT_THAT(result.message, HasSubstr("only 3 agree"));
  expect_no_pose(result);
}

TEST(EstimatePose, LinesAreRefused) {
  std::vector<Eigen::Vector3d> line;
  for (int i = -4; i <= 4; ++i) line.emplace_back(2 * i, i, 0.5 * i);
  const PoseResult exact = estimate(line, 180, 0.5);
  EXPECT_EQ(exact.status, PoseStatus::kCollinear);
  expect_no_pose(exact);
  // 0.012 mm at 55 px/mm are 0.7 px, which does not stand out of 3 x 0.3 px; 0.1 mm, 5.5 px, does.
  for (size_t i = 0; i < line.size(); ++i) line[i].z() += i % 2 == 0 ? 0.012 : -0.012;
  EXPECT_EQ(estimate(line, 180, 0.5).status, PoseStatus::kCollinear);
  for (size_t i = 0; i < line.size(); ++i) line[i].z() += i % 2 == 0 ? 0.088 : -0.088;
  EXPECT_NE(estimate(line, 180, 0.5).status, PoseStatus::kCollinear);
}

TEST(EstimatePose, ADotIsRefused) {
  const PoseResult result = estimate(cube_points(0.005), 180, 0.5);  // 0.5 px across
  EXPECT_EQ(result.status, PoseStatus::kCollinear);
  EXPECT_THAT(result.message, HasSubstr("all at one position"));
}

TEST(EstimatePose, EdgeOnIsRefused) {
  // The camera's centre lies in the points' plane.
  Rigid3d pose;
  pose.rotation = Eigen::AngleAxisd(0.5 * EIGEN_PI, Eigen::Vector3d::UnitX());
  pose.translation_mm = {1, 0, 180};
  std::mt19937_64 random(2);
  const auto points = slab_points(12, 10, 0, &random);
  const PoseResult result =
      estimate_pose(long_lens(), shot(long_lens(), pose, points, 0.3, &random));
  EXPECT_EQ(result.status, PoseStatus::kCollinear);
  EXPECT_THAT(result.message, HasSubstr("edge-on"));
}

TEST(EstimatePose, NoConsensusAmongRandomPairs) {
  std::mt19937_64 random(89);
  std::vector<PointPair> pairs = shot(long_lens(), camera_looking_at({0, 0, 0}, 180, 0.5, 1),
                                      slab_points(20, 10, 20, &random), 0, &random);
  spoil(long_lens(), 20, &pairs, &random);
  const PoseResult result = estimate_pose(long_lens(), pairs);
  EXPECT_EQ(result.status, PoseStatus::kNoConsensus);
  EXPECT_THAT(result.message, HasSubstr("20 point pairs"));
  expect_no_pose(result);
}

TEST(EstimatePose, AMirroredWorldIsRecognised) {
  std::mt19937_64 random(97);
  const auto slab = slab_points(12, 10, 20, &random);
  // Eight points of the ground, whose mirror image is the ground seen from below, and four above.
  auto ground = slab_points(12, 10, 0, &random);
  for (std::size_t i = 8; i < ground.size(); ++i) ground[i].z() += 12.0;
  for (const auto& points : {slab, ground}) {
    std::vector<PointPair> pairs =
        shot(long_lens(), camera_looking_at({0, 0, 0}, 180, 0.5, 1), points, 0.3, &random);
    EXPECT_EQ(estimate_pose(long_lens(), pairs).status, PoseStatus::kOk);
    for (PointPair& pair : pairs) pair.world_mm.y() = -pair.world_mm.y();
    const PoseResult result = estimate_pose(long_lens(), pairs);
    EXPECT_EQ(result.status, PoseStatus::kBehindCamera);
    EXPECT_THAT(result.message, HasSubstr("mirror image"));
    expect_no_pose(result);
  }
}

TEST(EstimatePose, AFarPlaneIsAmbiguous) {
  std::mt19937_64 random(101);
  const PoseResult result = estimate(slab_points(30, 10, 0, &random), 1500, 0.5);
  EXPECT_EQ(result.status, PoseStatus::kPlanarAmbiguity);
  EXPECT_THAT(result.message, HasSubstr("two poses"));
  EXPECT_TRUE(result.covariance.allFinite());
  EXPECT_LT(result.rms_px, 1);
  // The same plane near by is not, nor is a solid of the same size so far away.
  EXPECT_EQ(estimate(slab_points(30, 10, 0, &random), 180, 0.5).status, PoseStatus::kOk);
  EXPECT_EQ(estimate(slab_points(30, 10, 20, &random), 1500, 0.5).status, PoseStatus::kOk);
}

TEST(EstimatePose, ASpeckIsIllConditioned) {
  const PoseResult result = estimate(cube_points(0.025), 180, 0.5);  // 2.7 px across
  EXPECT_EQ(result.status, PoseStatus::kIllConditioned) << result.message;
  EXPECT_THAT(result.message, HasSubstr("too loosely"));
}

TEST(EstimatePose, LargeResidualsWidenTheCovariance) {
  std::mt19937_64 random(103);
  const auto points = slab_points(100, 10, 20, &random);
  PoseOptions options;
  options.inlier_px = 10;
  const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.5, 1);
  const PoseResult result =
      estimate_pose(long_lens(), shot(long_lens(), pose, points, 1.5, &random), options);
  ASSERT_EQ(result.status, PoseStatus::kOk) << result.message;
  // 194 degrees of freedom: a standard deviation of 5 %; four of them.
  EXPECT_NEAR(result.noise_std_px, 1.5, 0.2 * 1.5);
}

TEST(EstimatePose, SameDigitsEachTime) {
  std::mt19937_64 random(107);
  std::vector<PointPair> pairs = shot(wide_lens(), camera_looking_at({0, 0, 0}, 180, 0.5, 1),
                                      slab_points(50, 40, 20, &random), 0.3, &random);
  spoil(wide_lens(), 20, &pairs, &random);
  const PoseResult a = estimate_pose(wide_lens(), pairs);
  const PoseResult b = estimate_pose(wide_lens(), pairs);
  EXPECT_EQ(a.camera_from_world.rotation.coeffs(), b.camera_from_world.rotation.coeffs());
  EXPECT_EQ(a.camera_from_world.translation_mm, b.camera_from_world.translation_mm);
  EXPECT_EQ(a.covariance, b.covariance);
}

TEST(EstimatePose, BrokenPreconditionsThrow) {
  std::mt19937_64 random(109);
  std::vector<PointPair> pairs =
      shot(long_lens(), camera_looking_at({0, 0, 0}, 180, 0.5, 1), cube_points(10), 0.3, &random);
  CameraIntrinsics camera = long_lens();
  camera.fy_px = 0;
  EXPECT_THROW(estimate_pose(camera, pairs), std::invalid_argument);
  pairs[3].image_px.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(estimate_pose(long_lens(), pairs), std::invalid_argument);
  pairs[3] = {{1, 2, std::numeric_limits<double>::infinity()}, {5, 5}};
  EXPECT_THROW(estimate_pose(long_lens(), pairs), std::invalid_argument);
}

TEST(PoseOptions, CheckNamesTheField) {
  const auto message = [](auto change) -> std::string {
    PoseOptions options;
    change(options);
    try {
      options.Check();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(message([](auto&) {}), "");
  EXPECT_THAT(message([](auto& o) { o.inlier_px = 0; }), HasSubstr("inlier_px"));
  EXPECT_THAT(message([](auto& o) { o.confidence = 1; }), HasSubstr("confidence"));
  EXPECT_THAT(message([](auto& o) { o.point_std_px = std::nan(""); }), HasSubstr("point_std_px"));
  EXPECT_THAT(message([](auto& o) { o.ambiguity_ratio = 0.5; }), HasSubstr("ambiguity_ratio"));
}

}  // namespace
}  // namespace scattermeter::calib
