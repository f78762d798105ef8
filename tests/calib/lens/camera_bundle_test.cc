#include "calib/lens/camera_bundle.h"

#include <gtest/gtest.h>

#include "tests/fixtures/calib/board_scene.h"

namespace scattermeter::calib {
namespace {

const LensModel kModel{true, DistortionTerms::kK1K2};

TEST(CameraBundle, FindsTheTruthFromAPoorStart) {
  const BoardScene scene = board_scene(board_lens(), 6, 1);
  CameraBundle start = true_bundle(board_lens(), scene);
  start.lens.head<6>() << 650, 650, 319.5, 239.5, 0, 0;
  for (Rigid3d& pose : start.camera_from_board) pose.translation_mm.z() *= 0.95;
  const CameraBundle fit = adjust_bundle(scene.views, kModel, 640, 480, start);
  ASSERT_TRUE(fit.converged);
  EXPECT_LT(fit.sum_squares_px2, 1e-12);
  EXPECT_TRUE(fit.lens.isApprox(lens_parameters(board_lens()), 1e-7)) << fit.lens.transpose();
}

TEST(CameraBundle, CauchyHardlyFollowsWrongCorners) {
  const BoardScene scene = board_scene(board_lens(), 6, 2);
  std::vector<BoardView> views = scene.views;
  for (std::size_t i = 0; i < views.size(); ++i) views[i].corners[7 * i].image_px.x() += 20;
  const CameraBundle start = true_bundle(board_lens(), scene);
  const CameraBundle pulled = adjust_bundle(views, kModel, 640, 480, start);
  const CameraBundle robust = adjust_bundle(views, kModel, 640, 480, start, 0.1);
  EXPECT_GT(std::abs(pulled.lens[0] - 700), 1);
  EXPECT_LT(std::abs(robust.lens[0] - 700), 0.05);
}

TEST(CameraBundle, StartWithoutImageIsHandedBack) {
  const BoardScene scene = board_scene(board_lens(), 3, 3);
  CameraBundle start = true_bundle(board_lens(), scene);
  start.camera_from_board[1].translation_mm.z() *= -1;
  ::testing::internal::CaptureStderr();
  EXPECT_FALSE(adjust_bundle(scene.views, kModel, 640, 480, start).converged);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

// The reduced equations predict what a full refit does to a small change of the corners, and to
// the places of the board's corners.
TEST(CameraBundle, EquationsPredictTheRefit) {
  const BoardScene scene = board_scene(board_lens(), 6, 4);
  const CameraBundle start = true_bundle(board_lens(), scene);
  std::vector<BoardView> views = with_noise(scene.views, 1e-3, 5);
  const Eigen::Vector3d moved(0, 0, 0.01);
  for (BoardView& view : views) {
    for (PointPair& c : view.corners) {
      if (c.world_mm == Eigen::Vector3d(90, 60, 0)) c.world_mm += moved;
    }
  }
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(5, 5);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(5);
  Eigen::VectorXd by_board = Eigen::VectorXd::Zero(5);
  const std::vector<BoardView> noise_only = with_noise(scene.views, 1e-3, 5);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const ViewEquations e =
        view_equations(noise_only[i], scene.camera_from_board[i], board_lens(), kModel);
    information += e.information;
    gradient += e.gradient;
    for (std::size_t c = 0; c < views[i].corners.size(); ++c) {
      if (views[i].corners[c].world_mm.z() != 0) by_board += e.gradient_per_mm[c] * moved;
    }
  }
  const Eigen::VectorXd predicted = -information.ldlt().solve(gradient + by_board);
  const CameraBundle fit = adjust_bundle(views, kModel, 640, 480, start);
  const Eigen::MatrixXd map = parameter_map(kModel);
  const Eigen::VectorXd found =
      (map.transpose() * (fit.lens - start.lens)).cwiseQuotient(map.colwise().sum().transpose());
  EXPECT_GT(by_board.norm(), 0);
  for (Eigen::Index p = 0; p < 5; ++p) {
    EXPECT_NEAR(found[p], predicted[p], 0.02 * predicted.cwiseAbs()[p] + 1e-6) << p;
  }
}

}  // namespace
}  // namespace scattermeter::calib
