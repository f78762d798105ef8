#include "calib/pose/outline_look.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/mesh/bodies.h"
#include "tests/fixtures/calib/painted_body.h"

namespace scattermeter::calib {
namespace {

class OutlineLookTest : public ::testing::Test {
 protected:
  OutlineLook look(const Eigen::Vector3d& moved_mm, double bright = 800) const {
    return look_at_outline(contour_, painted_body(scene_, lens_, pose_, moved_mm, bright), noise_);
  }
  // Where the contour goes when the body moves, along the normal of each point.
  double predicted_px(const OutlineOffset& o, const Eigen::Vector3d& moved_mm) const {
    const ContourPoint& p = contour_[o.point_idx];
    return p.outward.dot(project(lens_, pose_, {p.point_mm + moved_mm}).front() - p.at_px);
  }

  RayScene scene_{cube_mesh()};
  CameraIntrinsics lens_ = outline_lens();
  Rigid3d pose_ = outline_view();
  SensorNoise noise_{6.0, 2.0};
  std::vector<ContourPoint> contour_ =
      contour_points(scene_, lens_, pose_, outline_cell_px(lens_.width_px));
};

TEST_F(OutlineLookTest, InPlace) {
  const OutlineLook found = look(Eigen::Vector3d::Zero());
  EXPECT_EQ(found.cell_px, 2);
  EXPECT_EQ(found.points, contour_.size());
  EXPECT_GT(found.found_share(), 0.97);
  EXPECT_TRUE(found.shift_px.isZero(0));
  for (const OutlineOffset& o : found.offsets) EXPECT_LT(std::abs(o.px), 1.0);
}

// Within the reach, and beyond it: the search is repeated about the shift of the whole.
TEST_F(OutlineLookTest, Displaced) {
  for (const double mm : {0.5, 6.0}) {
    const Eigen::Vector3d moved(mm, 0, 0);
    const OutlineLook found = look(moved);
    ASSERT_GT(found.found_share(), 0.95) << mm;
    double squares = 0;
    for (const OutlineOffset& o : found.offsets) {
      squares += std::pow(o.px - predicted_px(o, moved), 2);
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(found.offsets.size())), 1.0) << mm;
    EXPECT_EQ(found.shift_px.isZero(0), mm < 1.0);
  }
}

TEST_F(OutlineLookTest, NothingThere) {
  EXPECT_LT(look(Eigen::Vector3d::Zero(), 0).found_share(), 0.02);
  EXPECT_EQ(look_at_outline({}, painted_body(scene_, lens_, pose_, {0, 0, 0}), noise_).points, 0U);
}

TEST(OutlineCell, IsAboutFiveHundredInTheWidth) {
  EXPECT_EQ(outline_cell_px(240), 2);
  EXPECT_EQ(outline_cell_px(968), 2);
  EXPECT_EQ(outline_cell_px(3872), 8);
}

}  // namespace
}  // namespace scattermeter::calib
