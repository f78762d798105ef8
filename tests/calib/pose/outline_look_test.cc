#include "calib/pose/outline_look.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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

// A face in the shade that becomes bright inwards: its edge is where its light begins, not where
// that grows most, 11 cells farther in. Half of the light inside is reached up to 1.5 cells late.
TEST_F(OutlineLookTest, EdgeInTheShade) {
  capture::RawFrame frame = painted_body(scene_, lens_, pose_, Eigen::Vector3d::Zero(), 800);
  for (int x = 0; x < frame.width_px; ++x) {
    const double black = frame.black_counts[0];
    int lowest_px = 0;
    for (int y = frame.height_px - 1; y >= 0; --y) {
      std::uint16_t& sample = frame.samples[static_cast<std::size_t>(y * frame.width_px + x)];
      if (lowest_px == 0 && sample > black + 400) lowest_px = y;
      const double lit = std::min(1.0, 0.04 * std::exp((lowest_px - y) / 8.0));
      if (lowest_px > 0) sample = static_cast<std::uint16_t>(black + lit * (sample - black));
    }
  }
  const OutlineLook found = look_at_outline(contour_, frame, noise_);
  int below = 0;
  for (const OutlineOffset& o : found.offsets) {
    if (contour_[o.point_idx].outward.y() < 0.9) continue;
    EXPECT_LT(std::abs(o.px), 1.5 * found.cell_px);
    ++below;
  }
  EXPECT_GT(below, 10);
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
