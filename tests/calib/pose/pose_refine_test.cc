#include "calib/pose/pose_refine.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

ScenePose scene_pose(const PoseScene& scene, const Rigid3d& pose) {
  return {pose.rotation.toRotationMatrix(), (pose * scene.centroid_mm) / scene.scale_mm};
}

TEST(PoseScene, IsCentredAndOfUnitSizeAndKeepsThePose) {
  std::mt19937_64 random(5);
  std::vector<Eigen::Vector3d> points = slab_points(20, 10, 8, &random);
  for (Eigen::Vector3d& x : points) x += Eigen::Vector3d(1e6, -2e6, 3e5);
  const Rigid3d pose = camera_looking_at({1e6, -2e6, 3e5}, 180, 0.5, 2);
  const PoseScene scene = make_scene(long_lens(), shot(long_lens(), pose, points, 0, &random));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0;
  for (const Eigen::Vector3d& x : scene.points) {
    sum += x;
    squares += x.squaredNorm();
  }
  EXPECT_LT(sum.norm(), 1e-7);  // 2e6 mm is held to 2e-10 mm, of a scale of some 8 mm
  EXPECT_NEAR(squares / 20, 1, 1e-12);
  const Rigid3d back = camera_from_world(scene, scene_pose(scene, pose));
  EXPECT_LT(pose_error(back, pose).head<3>().norm(), 1e-12);
  EXPECT_LT((back.translation_mm - pose.translation_mm).norm(), 1e-6);
}

// The optimum, against OpenCV's Levenberg-Marquardt on the same pairs.
TEST(RefinePose, AgreesWithOpenCv) {
  for (const CameraIntrinsics& camera : {long_lens(), wide_lens()}) {
    std::mt19937_64 random(17);
    const std::vector<Eigen::Vector3d> points = slab_points(25, 30, 20, &random);
    const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.7, 0.4);
    const std::vector<PointPair> pairs = shot(camera, pose, points, 0.5, &random);

    const PoseScene scene = make_scene(camera, pairs);
    ScenePose start = scene_pose(scene, pose);
    start.rotation =
        Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, -1).normalized()) * start.rotation;
    start.center *= 1.1;
    const PoseFit fit = refine_pose(scene, std::vector<bool>(25, true), start);
    EXPECT_TRUE(fit.converged);
    const Rigid3d ours = camera_from_world(scene, fit.pose);

    std::vector<cv::Point3d> world;
    std::vector<cv::Point2d> image;
    for (const PointPair& pair : pairs) {
      world.emplace_back(pair.world_mm.x(), pair.world_mm.y(), pair.world_mm.z());
      image.emplace_back(pair.image_px.x(), pair.image_px.y());
    }
    const Eigen::AngleAxisd turn(pose.rotation);
    const Eigen::Vector3d w = turn.angle() * turn.axis();
    const Eigen::Vector3d& t = pose.translation_mm;
    cv::Mat rvec = (cv::Mat_<double>(3, 1) << w.x(), w.y(), w.z());
    cv::Mat tvec = (cv::Mat_<double>(3, 1) << t.x(), t.y(), t.z());
    const cv::Matx33d k(camera.fx_px, 0, camera.cx_px, 0, camera.fy_px, camera.cy_px, 0, 0, 1);
    cv::solvePnPRefineLM(
        world, image, k, camera.distortion, rvec, tvec,
        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-15));
    const Eigen::Vector3d their_w(rvec.at<double>(0), rvec.at<double>(1), rvec.at<double>(2));
    Rigid3d theirs;
    theirs.rotation = Eigen::AngleAxisd(their_w.norm(), their_w.normalized());
    theirs.translation_mm = {tvec.at<double>(0), tvec.at<double>(1), tvec.at<double>(2)};
    // Standard deviations are some 1e-4 rad and 0.01 mm; both stop well below a thousandth of it.
    const Eigen::Matrix<double, 6, 1> difference = pose_error(ours, theirs);
    EXPECT_LT(difference.head<3>().norm(), 1e-8);
    EXPECT_LT(difference.tail<3>().norm(), 1e-6);
  }
}

TEST(RefinePose, InformationIsThatOfCentralDifferences) {
  std::mt19937_64 random(23);
  const PoseScene scene =
      make_scene(wide_lens(), shot(wide_lens(), camera_looking_at({0, 0, 0}, 150, 0.6, 1),
                                   slab_points(9, 40, 30, &random), 0.3, &random));
  std::vector<bool> use(9, true);
  use[4] = false;
  const PoseFit fit =
      refine_pose(scene, use, scene_pose(scene, camera_looking_at({0, 0, 0}, 150, 0.6, 1)));
  const auto moved = [&](int i, double h) {
    Eigen::Matrix<double, 6, 1> step = Eigen::Matrix<double, 6, 1>::Zero();
    step[i] = h;
    const Eigen::Vector3d w = step.head<3>();
    ScenePose pose = fit.pose;
    if (w.norm() > 0) pose.rotation = Eigen::AngleAxisd(w.norm(), w.normalized()) * pose.rotation;
    pose.center += step.tail<3>();
    return residuals(scene, pose);
  };
  Eigen::MatrixXd jacobian(16, 6);
  for (int i = 0; i < 6; ++i) {
    const double h = 1e-5;
    const auto high = moved(i, h);
    const auto low = moved(i, -h);
    Eigen::Index row = 0;
    for (size_t k = 0; k < 9; ++k) {
      if (!use[k]) continue;
      jacobian.block<2, 1>(row, i) = (high[k] - low[k]) / (2 * h);
      row += 2;
    }
  }
  const Eigen::MatrixXd numeric = jacobian.transpose() * jacobian;
  EXPECT_LT((numeric - fit.information).norm(), 1e-7 * fit.information.norm()) << numeric << "\n\n"
                                                                               << fit.information;
}

TEST(RefinePose, AStartWithoutImageIsSaidSo) {
  std::mt19937_64 random(2);
  const Rigid3d pose = camera_looking_at({0, 0, 0}, 180, 0.4, 1);
  const PoseScene scene =
      make_scene(long_lens(), shot(long_lens(), pose, cube_points(10), 0, &random));
  ScenePose behind = scene_pose(scene, pose);
  behind.center = -behind.center;
  const PoseFit fit = refine_pose(scene, std::vector<bool>(12, true), behind);
  EXPECT_FALSE(fit.converged);
  EXPECT_TRUE(std::isinf(fit.sum_squares_px2));
}

TEST(PoseDifference, IsTheMotionBetweenThem) {
  ScenePose from{Eigen::AngleAxisd(1.2, Eigen::Vector3d(3, -1, 2).normalized()).matrix(),
                 {1, 2, 9}};
  const Eigen::Vector3d w(0.1, -0.2, 0.05);
  const ScenePose to{Eigen::AngleAxisd(w.norm(), w.normalized()) * from.rotation,
                     from.center + Eigen::Vector3d(0.3, 0, -1)};
  const Eigen::Matrix<double, 6, 1> difference = pose_difference(from, to);
  EXPECT_LT((difference.head<3>() - w).norm(), 1e-14);
  EXPECT_LT((difference.tail<3>() - Eigen::Vector3d(0.3, 0, -1)).norm(), 1e-14);
}

}  // namespace
}  // namespace scattermeter::calib
