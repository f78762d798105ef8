#include "calib/pose/edge_scatter.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/calib/edge_scene.h"

namespace scattermeter::calib {
namespace {

TEST(EdgeScatter, IsFoundAgain) {
  const RayScene scene(test_support::make_cube());
  std::mt19937_64 random(3);
  double line = 0, piece = 0;
  constexpr int kSeeds = 100;
  for (int seed = 0; seed < kSeeds; ++seed) {
    auto points = outline(scene, small_lens(), cube_view(), 0, 0.2, 0.1, 1, &random);
    for (EdgePoint& p : points) p.std_px = 0.05;  // sqrt(0.1^2 - 0.05^2) is not told
    EdgeFitOptions model;
    model.free = {0, 1, 2, 3, 4, 5};
    model.prior = Eigen::MatrixXd::Zero(edge_parameters(points), edge_parameters(points));
    const EdgeScatter s = edge_scatter(points, small_lens(), cube_view(), model, 0.0);
    line += s.line_std_px * s.line_std_px / kSeeds;
    piece += s.piece_std_px * s.piece_std_px / kSeeds;
    EXPECT_GE(edge_scatter(points, small_lens(), cube_view(), model, 0.3).line_std_px, 0.3);
  }
  // Twelve numbers less six a draw: the mean of 100 squares is known to 6 %; pieces that the lines'
  // own straight lines take along widen it.
  EXPECT_NEAR(std::sqrt(line), 0.2, 0.04);
  EXPECT_NEAR(std::sqrt(piece), std::sqrt(0.01 - 0.0025), 0.01);
}

}  // namespace
}  // namespace scattermeter::calib
