#include "core/camera/camera_model.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <tbb/global_control.h>

#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::vector<CameraIntrinsics> cameras() {
  CameraIntrinsics four = calib::wide_lens();
  four.distortion.resize(4);
  CameraIntrinsics eight = calib::wide_lens();
  eight.distortion = {1.2, 0.4, 0.0005, -0.0008, 0.02, 1.6, 0.9, 0.1};
  return {calib::long_lens(), four, calib::wide_lens(), eight};
}

// OpenCV's own projection as the reference.
std::vector<cv::Point2d> opencv_images(const CameraIntrinsics& c, const Rigid3d& pose,
                                       const std::vector<Eigen::Vector3d>& points) {
  const cv::Matx33d k(c.fx_px, 0, c.cx_px, 0, c.fy_px, c.cy_px, 0, 0, 1);
  const Eigen::AngleAxisd turn(pose.rotation);
  const Eigen::Vector3d w = turn.angle() * turn.axis();
  const Eigen::Vector3d& t = pose.translation_mm;
  std::vector<cv::Point3d> world;
  world.reserve(points.size());
  for (const Eigen::Vector3d& x : points) world.emplace_back(x.x(), x.y(), x.z());
  std::vector<cv::Point2d> images;
  cv::projectPoints(world, cv::Vec3d(w.x(), w.y(), w.z()), cv::Vec3d(t.x(), t.y(), t.z()), k,
                    c.distortion, images);
  return images;
}

TEST(Project, AgreesWithOpenCv) {
  std::mt19937_64 random(3);
  const std::vector<Eigen::Vector3d> points = slab_points(500, 60, 60, &random);
  const Rigid3d pose = camera_looking_at({0, 0, 0}, 200, 0.6, 1.1);
  for (const CameraIntrinsics& camera : cameras()) {
    const std::vector<Eigen::Vector2d> ours = project(camera, pose, points);
    const std::vector<cv::Point2d> theirs = opencv_images(camera, pose, points);
    for (size_t i = 0; i < ours.size(); ++i) {
      // Images lie within 1e4 px, of which a double holds 2e-12; some ten operations.
      EXPECT_NEAR(ours[i].x(), theirs[i].x, 1e-9);
      EXPECT_NEAR(ours[i].y(), theirs[i].y, 1e-9);
    }
  }
}

TEST(Project, PointsWithoutImageAreNan) {
  CameraIntrinsics barrel = calib::long_lens();
  barrel.distortion = {-0.3, 0, 0, 0};  // folds back at X / Z = 1.054
  const std::vector<Eigen::Vector2d> images =
      project(barrel, Rigid3d{},
              {{0, 0, -1}, {0, 0, 0}, {1, 1, 0}, {1.06, 0, 1}, {0, kNan, 1}, {0.5, 0, 1}});
  for (size_t i = 0; i < 5; ++i) EXPECT_TRUE(images[i].array().isNaN().all()) << i;
  EXPECT_TRUE(images[5].allFinite());
  EXPECT_TRUE(project(barrel, Rigid3d{}, {}).empty());
}

TEST(Undistort, OpenCvProjectsBackWithinAMillionthOfAPixel) {
  std::vector<Eigen::Vector2d> pixels;
  for (int y = 0; y < 2592; y += 37) {
    for (int x = 0; x < 3872; x += 43) pixels.emplace_back(x, y);
  }
  for (const CameraIntrinsics& camera : cameras()) {
    std::vector<Eigen::Vector3d> points;
    for (const Eigen::Vector2d& ray : undistort(camera, pixels)) {
      points.emplace_back(ray.x(), ray.y(), 1);
    }
    const std::vector<cv::Point2d> back = opencv_images(camera, Rigid3d{}, points);
    double worst = 0;
    for (size_t i = 0; i < pixels.size(); ++i) {
      worst = std::max(worst, (Eigen::Vector2d(back[i].x, back[i].y) - pixels[i]).norm());
    }
    EXPECT_LT(worst, 1e-6);
  }
}

TEST(PixelRays, WithoutDistortionTheyAreTheClosedForm) {
  const std::vector<Eigen::Vector3f> rays = pixel_rays_in_camera(calib::long_lens(), -5, 7, 30, 20);
  ASSERT_EQ(rays.size(), 600U);
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 30; ++column) {
      const Eigen::Vector3f& ray =
          rays[static_cast<size_t>(row) * 30 + static_cast<size_t>(column)];
      EXPECT_EQ(ray.x(), static_cast<float>((column - 5 - 1935.5) / 9836));
      EXPECT_EQ(ray.y(), static_cast<float>((row + 7 - 1295.5) / 9836));
      EXPECT_EQ(ray.z(), 1.0F);
    }
  }
}

// The largest difference to the rays of the pixels one by one.
double worst_ray(const CameraIntrinsics& camera) {
  const std::vector<Eigen::Vector3f> rays = pixel_rays_in_camera(camera, 0, 0, 3872, 40);
  std::vector<Eigen::Vector2d> pixels;
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 3872; ++column) pixels.emplace_back(column, row);
  }
  const std::vector<Eigen::Vector2d> exact = undistort(camera, pixels);
  double worst = 0;
  for (size_t i = 0; i < exact.size(); ++i) {
    worst = std::max(worst, (rays[i].head<2>().cast<double>() - exact[i]).norm());
  }
  return worst;
}

// Where cubics do between pixels, and where the lens bends too much for them.
TEST(PixelRays, AreTheUndistortedPixelsRoundedToFloat) {
  // |x|, |y| < 1: half a unit in the last place is 3e-8 each; and 2e-9 px of two solutions' spread.
  EXPECT_LT(worst_ray(calib::wide_lens()), 4.5e-8);
  CameraIntrinsics barrel = calib::wide_lens();
  barrel.distortion = {-0.28, 0.1, 0.002, -0.001, 0.05};
  EXPECT_LT(worst_ray(barrel), 4.5e-8);
  // |x|, |y| < 0.25: 7.5e-9 each; and 1e-6 px.
  EXPECT_LT(worst_ray(calib::long_lens()), 1.06e-8 + 1e-6 / 9836);
}

TEST(PixelRays, NanWhereTheModelHasNoInverse) {
  // Largest image radius 0.7027 * 2800 = 1967.6 px from the centre: a corner at 2300 px has no ray.
  CameraIntrinsics barrel = calib::wide_lens();
  barrel.distortion = {-0.3, 0, 0, 0};
  const std::vector<Eigen::Vector3f> rays = pixel_rays_in_camera(barrel, 0, 0, 3872, 2);
  EXPECT_TRUE(rays.front().array().isNaN().all());
  EXPECT_TRUE(rays.back().array().isNaN().all());
  // Straight above the centre, 1280 px from it, there is one; also after a row began without.
  EXPECT_TRUE(rays[1950].allFinite());
}

TEST(PixelRays, SameDigitsForAnyNumberOfThreads) {
  const auto run = [](size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return pixel_rays_in_camera(calib::wide_lens(), 100, 50, 400, 333);
  };
  const std::vector<Eigen::Vector3f> one = run(1);
  const std::vector<Eigen::Vector3f> four = run(4);
  ASSERT_EQ(one.size(), four.size());
  EXPECT_TRUE(one == four);
}

TEST(PixelRays, EmptyAndNegativeRectangles) {
  EXPECT_TRUE(pixel_rays_in_camera(calib::long_lens(), 0, 0, 0, 5).empty());
  EXPECT_TRUE(pixel_rays_in_camera(calib::long_lens(), 0, 0, 5, 0).empty());
  EXPECT_THROW(pixel_rays_in_camera(calib::long_lens(), 0, 0, -1, 5), std::invalid_argument);
}

TEST(IntrinsicsProblem, NamesTheField) {
  EXPECT_EQ(intrinsics_problem(calib::long_lens()), "");
  EXPECT_EQ(intrinsics_problem(calib::wide_lens()), "");
  const auto with = [](auto change) {
    CameraIntrinsics intrinsics = calib::wide_lens();
    change(intrinsics);
    return intrinsics_problem(intrinsics);
  };
  EXPECT_THAT(with([](auto& c) { c.width_px = 0; }), HasSubstr("image size"));
  EXPECT_THAT(with([](auto& c) { c.height_px = -2592; }), HasSubstr("-2592"));
  EXPECT_THAT(with([](auto& c) { c.fx_px = 0; }), HasSubstr("fx_px"));
  EXPECT_THAT(with([](auto& c) { c.fy_px = kNan; }), HasSubstr("fy_px"));
  EXPECT_THAT(with([](auto& c) { c.cx_px = 3872 * 1.6; }), HasSubstr("cx_px"));
  EXPECT_THAT(with([](auto& c) { c.cy_px = kNan; }), HasSubstr("cy_px"));
  EXPECT_THAT(with([](auto& c) { c.distortion.resize(6); }), HasSubstr("got 6"));
  EXPECT_THAT(with([](auto& c) { c.distortion[2] = kNan; }), HasSubstr("term 3"));
}

}  // namespace
}  // namespace scattermeter::calib
