#include "calib/lens/camera_start.h"

#include <gtest/gtest.h>

#include "tests/fixtures/calib/board_scene.h"
#include "tests/fixtures/calib/pose_scenes.h"

namespace scattermeter::calib {
namespace {

TEST(CameraStart, NearTheTruthWithoutAnyHint) {
  for (const double focal : {350.0, 700.0, 2400.0}) {
    CameraIntrinsics lens = board_lens();
    BoardScene scene = board_scene(lens, 8, 1);
    lens.fx_px = lens.fy_px = focal;
    if (focal != 700) lens.distortion = {};
    // From farther away with a longer lens: the board fills the frame as before.
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
      scene.camera_from_board[i].translation_mm.z() *= focal / 700;
      const std::vector<Eigen::Vector2d> all = [&] {
        std::vector<Eigen::Vector3d> x;
        for (const PointPair& c : scene.views[i].corners) x.push_back(c.world_mm);
        return project(lens, scene.camera_from_board[i], x);
      }();
      for (std::size_t c = 0; c < all.size(); ++c) scene.views[i].corners[c].image_px = all[c];
    }
    const CameraBundle start = start_camera(with_noise(scene.views, 0.1, 2), 640, 480);
    EXPECT_TRUE(start.converged);
    EXPECT_NEAR(start.lens[0], focal, 0.05 * focal);
    EXPECT_LT(median_residual_px(scene.views, start, 640, 480), 0.5);
  }
}

TEST(CameraStart, PoseOfOneView) {
  const BoardScene scene = board_scene(board_lens(), 3, 4);
  for (std::size_t i = 0; i < 3; ++i) {
    const Rigid3d pose = board_pose(scene.views[i], board_lens());
    EXPECT_LT(pose_error(pose, scene.camera_from_board[i]).norm(), 0.1);
  }
}

}  // namespace
}  // namespace scattermeter::calib
