#include "calib/pose/edge_points.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/edge_scene.h"

namespace scattermeter::calib {
namespace {

// Of a picture by the same pose they are where they are predicted.
TEST(EdgePoints, LieWhereTheMeshSays) {
  const RayScene scene(test_support::make_cube());
  std::mt19937_64 random(1);
  const Rigid3d pose = cube_view();
  const std::vector<EdgeShot> shots = {
      {&scene, 0, picture(scene, small_lens(), pose, 1000, &random)}};
  const auto points = edge_points(shots, small_lens(), pose);
  EXPECT_GT(points.size(), 20U);
  std::set<int> lines;
  double mean = 0;
  for (const EdgePoint& p : points) {
    lines.insert(p.line_idx);
    EXPECT_LT(std::abs(p.offset_px), 0.15);
    mean += p.offset_px / static_cast<double>(points.size());
  }
  EXPECT_EQ(lines.size(), 6U);
  EXPECT_LT(std::abs(mean), 0.01);
  // On cells, in pixels of the raw as well.
  EdgePointOptions options;
  options.factor = 2;
  options.half_width_px = 3;
  for (const EdgePoint& p : edge_points(shots, small_lens(), pose, options)) {
    EXPECT_LT(std::abs(p.offset_px), 0.3);
  }
}

}  // namespace
}  // namespace scattermeter::calib
