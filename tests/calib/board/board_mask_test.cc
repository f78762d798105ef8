#include "calib/board/board_mask.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/charuco_scene.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter::calib {
namespace {

CharucoBoard small_board() {
  CharucoBoard board;
  board.squares_x = 6;
  board.squares_y = 5;
  board.square_mm = 10;
  board.marker_mm = 7;
  return board;
}

CameraIntrinsics small_camera() {
  CameraIntrinsics k;
  k.width_px = 320;
  k.height_px = 240;
  k.fx_px = k.fy_px = 600;
  k.cx_px = 160.3;
  k.cy_px = 119.6;
  return k;
}

CfaSamples whole_frame(const CameraIntrinsics& k) {
  CfaSamples s;
  s.width = k.width_px;
  s.height = k.height_px;
  const auto n = static_cast<std::size_t>(k.width_px) * static_cast<std::size_t>(k.height_px);
  s.signal_counts.assign(n, 1.0F);
  s.variance_counts2.assign(n, 1.0F);
  s.clipped.assign(n, 0);
  return s;
}

class BoardMask : public ::testing::Test {
 protected:
  std::uint8_t mark_at(const Eigen::Vector3d& point_mm) const {
    const Eigen::Vector2d px = project(camera_, pose_, {point_mm}).front();
    return samples_.clipped[static_cast<std::size_t>(std::lround(px.y())) * 320 +
                            static_cast<std::size_t>(std::lround(px.x()))];
  }
  CharucoBoard board_ = small_board();
  CameraIntrinsics camera_ = small_camera();
  Rigid3d pose_ = camera_above_board(board_, 150, 0.5, -M_PI / 2);
  CfaSamples samples_ = whole_frame(camera_);
};

TEST_F(BoardMask, PaperIsMaskedInkIsNot) {
  const RayScene body(scattermeter::test_support::make_box({24, 20, 0}, {36, 30, 12}));
  mask_paper(board_, body, camera_, pose_, 2, samples_);
  const CharucoPattern pattern(board_);
  int paper = 0, ink = 0;
  for (double x = 0.25; x < 60; x += 0.5) {
    for (double y = 0.25; y < 50; y += 0.5) {
      // Far from the body, and where the pattern is the same all around: of ink farther than the
      // border reaches (2 px and half of one are 0.7 mm), of paper by the rounding to a pixel.
      if (std::hypot(x - 30, y - 25) < 20) continue;
      const double here = pattern.reflectance(x, y);
      const double reach = here > 0 ? 0.4 : 1.1;
      bool even = true;
      for (double dx = -reach; dx <= reach; dx += 0.1) {
        for (double dy = -reach; dy <= reach; dy += 0.1) {
          even = even && pattern.reflectance(x + dx, y + dy) == here;
        }
      }
      if (!even) continue;
      EXPECT_EQ(mark_at({x, y, 0}), here > 0 ? kSampleDefect : 0) << x << " " << y;
      (here > 0 ? paper : ink) += 1;
    }
  }
  EXPECT_GT(paper, 500);
  EXPECT_GT(ink, 500);
  EXPECT_EQ(mark_at({-3, 25, 0}), kSampleDefect);  // the margin
  EXPECT_EQ(mark_at({-8, 25, 0}), 0);
  // The body's top and the side that is seen.
  for (double x = 24.6; x < 35.5; x += 1) {
    EXPECT_EQ(mark_at({x, 25, 12}), 0) << x;
    EXPECT_EQ(mark_at({x, 20, 6}), 0) << x;
  }
}

TEST_F(BoardMask, FromBehindThereIsNone) {
  board_.world_from_board.rotation = Eigen::Quaterniond(0, 1, 0, 0);  // the print faces down
  mask_paper(board_, RayScene(scattermeter::test_support::make_box({24, 20, 0}, {36, 30, 12})),
             camera_, pose_, 2, samples_);
  for (const std::uint8_t c : samples_.clipped) ASSERT_EQ(c, 0);
  EXPECT_THROW(
      mask_paper(board_, RayScene(scattermeter::test_support::make_box({0, 0, 0}, {1, 1, 1})),
                 camera_, pose_, -1, samples_),
      std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
