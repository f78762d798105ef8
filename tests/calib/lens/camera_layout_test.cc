#include "calib/lens/camera_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/board_scene.h"

namespace scattermeter::calib {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(CameraLayout, AngleFieldsAndCorners) {
  const CameraIntrinsics lens = board_lens();
  const BoardScene scene = board_scene(lens, 10, 1);
  const CameraLayout good = camera_layout(scene.views, true_bundle(lens, scene), 640, 480);
  EXPECT_GT(good.widest_angle_rad, 0.6);
  const BoardScene flat = board_scene(lens, 5, 1, 0.0);
  EXPECT_LT(camera_layout(flat.views, true_bundle(lens, flat), 640, 480).widest_angle_rad, 0.01);

  BoardView corners{"v", {{{0, 0, 0}, {1, 1}}, {{0, 0, 0}, {639, 479}}, {{0, 0, 0}, {320, 240}}}};
  const CameraLayout bare = camera_layout({corners}, {}, 640, 480);
  EXPECT_THAT(bare.bare_corners, ElementsAre("upper right", "lower left"));
  EXPECT_NEAR(bare.covered_share, 3.0 / 25, 1e-12);
}

TEST(CameraLayout, WarnsOfWhatIsWeak) {
  EXPECT_THAT(layout_warnings({0.6, 1, {}}, 10), ElementsAre());
  EXPECT_THAT(layout_warnings({0.1, 1, {"upper left"}}, 4),
              ElementsAre(HasSubstr("only 4 views"), HasSubstr("5.7 degrees"),
                          HasSubstr("upper left corner")));
}

}  // namespace
}  // namespace scattermeter::calib
