#include "calib/pose/coarse_turn.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/edge_scene.h"

namespace scattermeter::calib {
namespace {

TEST(CoarseTurn, CellsAreAPowerOfTwo) {
  EXPECT_EQ(coarse_cell_px(240), 2);
  EXPECT_EQ(coarse_cell_px(521), 2);
  EXPECT_EQ(coarse_cell_px(522), 4);
  EXPECT_EQ(coarse_cell_px(3872), 16);
}

class CoarseTurnTest : public ::testing::Test {
 protected:
  std::vector<EdgeShot> shot(const Rigid3d& pose, double counts) const {
    std::mt19937_64 random(1);
    return {{&scene_, 0, picture(scene_, small_lens(), pose, counts, &random)}};
  }

  RayScene scene_{test_support::make_cube()};
};

// A camera turned by 1.5 degrees about its own centre, 16 px: found to the cell of 2 px, and the
// centre stays.
TEST_F(CoarseTurnTest, FindsTheTurn) {
  const Rigid3d turn{Eigen::Quaterniond(Eigen::AngleAxisd(0.026, Eigen::Vector3d(0.6, -0.8, 0))),
                     Eigen::Vector3d::Zero()};
  const Rigid3d truth = turn * cube_view();
  const auto found = turn_coarsely(shot(truth, 1000), small_lens(), cube_view(), 0.1);
  ASSERT_TRUE(found);
  const Eigen::Vector3d middle(0, 0, 10);
  const auto px = [&](const Rigid3d& pose) { return project(small_lens(), pose, {middle})[0]; };
  EXPECT_GT((px(cube_view()) - px(truth)).norm(), 10.0);
  EXPECT_LT((px(*found) - px(truth)).norm(), 2.0);
  EXPECT_LT((inverse(*found).translation_mm - inverse(cube_view()).translation_mm).norm(), 1e-9);
}

TEST_F(CoarseTurnTest, LeavesARightPoseAlone) {
  const auto found = turn_coarsely(shot(cube_view(), 1000), small_lens(), cube_view(), 0.06);
  ASSERT_TRUE(found);
  EXPECT_LT(pose_error(*found, cube_view()).head<3>().norm(), 2.0 / 620);
}

TEST_F(CoarseTurnTest, FindsNothingInTheDark) {
  EXPECT_FALSE(turn_coarsely(shot(cube_view(), 0), small_lens(), cube_view(), 0.06));
}

}  // namespace
}  // namespace scattermeter::calib
