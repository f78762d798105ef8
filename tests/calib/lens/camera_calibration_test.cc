#include "calib/lens/camera_calibration.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/board_scene.h"
#include "tests/fixtures/core/derivative_check.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

// Estimates over many draws of the corners' noise: no bias beyond its own uncertainty, predicted
// against sampled deviation within 20 % (the sample's own deviation at 100 draws: 7 %).
TEST(CameraCalibration, IsUnbiasedWithTheStatedDeviation) {
  constexpr int kSeeds = 100;
  const BoardScene scene = board_scene(board_lens(), 8, 1);
  CameraCalibrationOptions options;
  options.model = LensModel{true, DistortionTerms::kK1K2};
  const double truth[] = {700, 325, 236, -0.2, 0.1};
  double sum[5] = {}, squares[5] = {}, variance[5] = {};
  int used = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const CameraCalibration c =
        calibrate_camera(with_noise(scene.views, 0.15, 100 + seed), 640, 480, options);
    ASSERT_EQ(c.status, CameraCalibrationStatus::kOk) << c.message;
    EXPECT_TRUE(c.left_out.empty());
    ++used;
    for (std::size_t p = 0; p < 5; ++p) {
      const double error = c.value(p) - truth[p];
      sum[p] += error;
      squares[p] += error * error;
      variance[p] += c.covariance(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(p));
    }
  }
  for (std::size_t p = 0; p < 5; ++p) {
    const double mean = sum[p] / used;
    const double sampled = std::sqrt(squares[p] / used - mean * mean);
    EXPECT_LT(std::abs(mean), 3.5 * sampled / std::sqrt(used)) << p;
    EXPECT_NEAR(std::sqrt(variance[p] / used) / sampled, 1, 0.2) << p;
  }
}

// The same with the model chosen each time: the focal length stays unbiased.
TEST(CameraCalibration, ChoosingTheModelDoesNotBias) {
  constexpr int kSeeds = 50;
  const BoardScene scene = board_scene(board_lens(), 8, 1);
  double sum = 0, squares = 0, variance = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const CameraCalibration c =
        calibrate_camera(with_noise(scene.views, 0.15, 500 + seed), 640, 480);
    ASSERT_EQ(c.status, CameraCalibrationStatus::kOk) << c.message;
    const double error = c.intrinsics.fx_px - 700;
    sum += error / kSeeds;
    squares += error * error / kSeeds;
    variance += c.covariance(0, 0) / kSeeds;
  }
  const double sampled = std::sqrt(squares - sum * sum);
  EXPECT_LT(std::abs(sum), 3.5 * sampled / std::sqrt(kSeeds));
  EXPECT_NEAR(std::sqrt(variance) / sampled, 1, 0.2);
}

TEST(CameraCalibration, RefusesWhatDoesNotDetermineTheLens) {
  const CameraIntrinsics lens = board_lens();
  const auto run = [](const std::vector<BoardView>& views) {
    const CameraCalibration c = calibrate_camera(with_noise(views, 0.15, 3), 640, 480);
    EXPECT_NE(c.message, "");
    return c;
  };
  // Seen frontally only.
  const CameraCalibration flat = run(board_scene(lens, 10, 1, 0.0).views);
  EXPECT_EQ(flat.status, CameraCalibrationStatus::kNotDetermined);
  EXPECT_THAT(flat.message, HasSubstr("tilt the board"));
  // Two views, and none.
  EXPECT_EQ(run(board_scene(lens, 2, 1).views).status, CameraCalibrationStatus::kTooFewViews);
  EXPECT_EQ(calibrate_camera({}, 640, 480).status, CameraCalibrationStatus::kTooFewViews);
  // The squares counted wrongly: rows of nine corners taken for rows of eight.
  std::vector<BoardView> views = board_scene(lens, 8, 1).views;
  for (BoardView& view : views) {
    for (std::size_t i = 0; i < view.corners.size(); ++i) {
      view.corners[i].world_mm = {30.0 * static_cast<double>(i % 8),
                                  30.0 * static_cast<double>(i / 8), 0};
    }
  }
  EXPECT_NE(run(views).status, CameraCalibrationStatus::kOk);
}

// A picture of a camera with another lens fits by itself, but not with the others.
TEST(CameraCalibration, LeavesOutThePictureOfAnotherLens) {
  const CameraIntrinsics lens = board_lens();
  CameraIntrinsics other = lens;
  other.fx_px = other.fy_px = 760;
  std::vector<BoardView> views = board_scene(lens, 10, 1).views;
  views[4] = board_scene(other, 10, 1).views[4];
  const CameraCalibration c = calibrate_camera(with_noise(views, 0.05, 3), 640, 480);
  ASSERT_EQ(c.status, CameraCalibrationStatus::kOk) << c.message;
  ASSERT_EQ(c.left_out.size(), 1U);
  EXPECT_EQ(c.left_out[0].name, "view4");
  EXPECT_LT(std::abs(c.value(0) - 700), 4 * c.std(0));
}

TEST(CameraCalibration, ShiftPerParameterIsTheDerivative) {
  CameraIntrinsics k = board_lens();
  const std::vector<std::string> names = {"f_px", "cx_px", "cy_px", "k1", "k2"};
  const Eigen::Vector2d pixel(60, 400);
  const Eigen::Vector2d ray = undistort(k, {pixel})[0];
  const auto image = [&](const Eigen::VectorXd& p) -> Eigen::VectorXd {
    CameraIntrinsics moved = k;
    moved.fx_px = moved.fy_px = p[0];
    moved.cx_px = p[1];
    moved.cy_px = p[2];
    moved.distortion = {p[3], p[4], 0, 0, 0};
    return project(moved, {}, {{ray.x(), ray.y(), 1}})[0];
  };
  Eigen::VectorXd p(5);
  p << 700, 325, 236, -0.2, 0.1;
  test_support::expect_derivatives(image, p, image_shift_per_parameter(k, names, pixel));
}

TEST(CameraCalibration, PreconditionsAreNamed) {
  EXPECT_THROW(calibrate_camera({}, 0, 480), std::invalid_argument);
  EXPECT_THROW(calibrate_camera({{"a", {}}, {"a", {}}}, 640, 480), std::invalid_argument);
  EXPECT_THROW(calibrate_camera({{"a", {{{0, 0, 0}, {std::nan(""), 0}}}}}, 640, 480),
               std::invalid_argument);
  CameraCalibrationOptions options;
  options.board_std_mm = -1;
  EXPECT_THROW(calibrate_camera({}, 640, 480, options), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
