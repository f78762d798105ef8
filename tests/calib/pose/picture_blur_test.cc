#include "calib/pose/picture_blur.h"

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

// Edges all around a body, of a picture with an even blur that moved along x as well.
std::vector<EdgeBlur> edges_around(double even_px, double moved_px, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> error(0.0, 0.15);
  std::vector<EdgeBlur> out;
  for (int i = 0; i < 24; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 24.0;
    const Eigen::Vector2d outward(std::cos(t), std::sin(t));
    out.push_back({outward, std::hypot(even_px, moved_px * outward.x()) + error(random)});
  }
  return out;
}

TEST(PictureBlur, FindsTheMotionAmongEdges) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    EXPECT_NEAR(picture_blur_px(edges_around(0.6, 1.2, seed)), std::hypot(0.6, 1.2), 0.2) << seed;
  }
}

// The same blur in all directions stays the median, whatever the scatter of the edges seems to say.
TEST(PictureBlur, ChanceIsNoMotion) {
  int moved = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const double px = picture_blur_px(edges_around(0.8, 0.0, seed));
    EXPECT_NEAR(px, 0.8, 0.2) << seed;
    std::vector<EdgeBlur> turned = edges_around(0.8, 0.0, seed);
    for (EdgeBlur& e : turned) e.outward = Eigen::Vector2d(1.0, 0.0);
    moved += picture_blur_px(turned) != px ? 1 : 0;
  }
  EXPECT_LE(moved, 1);
}

// Where edges run in two directions close to each other, nothing is known of the others.
TEST(PictureBlur, DoesNotExceedTheWidestEdge) {
  std::vector<EdgeBlur> edges;
  for (int i = 0; i < 12; ++i) {
    edges.push_back({{1.0, 0.0}, 1.0 + 0.001 * i});
    edges.push_back({{std::cos(0.2), std::sin(0.2)}, 0.6 + 0.001 * i});
  }
  EXPECT_LE(picture_blur_px(edges), 1.011);
  EXPECT_GT(picture_blur_px(edges), 0.9);
  EXPECT_THROW(picture_blur_px({}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::calib
