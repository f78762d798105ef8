#include "core/light/lit_layer.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

const std::array<Eigen::Vector3d, 3> kCorners = {
    {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}};

LitTriangleRgb patch_of(const PointIrradiance& f) {
  return {kCorners, {f(kCorners[0]), f(kCorners[1]), f(kCorners[2])}, 0};
}

double total(const std::vector<LitTriangleRgb>& triangles, int channel) {
  return channel_light(triangles, channel, 1).patch_power_sr[0];
}

// The integral of a quadratic is met to what is allowed, and better for less.
TEST(LitLayer, SmoothFieldIsCutUntilItIsLinear) {
  const PointIrradiance f = [](const Eigen::Vector3d& p) {
    return Eigen::Array3d(1.0 + p.x() * p.x(), 1.0, p.x() + p.y()).eval();
  };
  const double exact = 0.5 + 1.0 / 12.0;
  std::size_t last = 0;
  for (const double allowed : {1e-1, 1e-2, 1e-3}) {
    std::vector<LitTriangleRgb> out;
    append_smooth(patch_of(f), f, Eigen::Array3d::Constant(allowed), Eigen::Array3d::Ones(), 12,
                  out);
    EXPECT_NEAR(total(out, 0), exact, 0.5 * allowed);
    EXPECT_NEAR(total(out, 1), 0.5, 1e-12);
    EXPECT_NEAR(total(out, 2), 1.0 / 3.0, 1e-12);
    EXPECT_GT(out.size(), last);
    last = out.size();
  }
  std::vector<LitTriangleRgb> out;
  append_smooth(patch_of(f), f, Eigen::Array3d::Constant(1e-3), Eigen::Array3d::Ones(), 0, out);
  EXPECT_EQ(out.size(), 1U);  // not allowed to cut
}

// A step along x + 0.3 y = 0.5: lit is the triangle (0.5, 0), (1, 0), (2/7, 5/7).
TEST(LitLayer, StepIsFound) {
  const PointIrradiance f = [](const Eigen::Vector3d& p) {
    return Eigen::Array3d::Constant(p.x() + 0.3 * p.y() > 0.5 ? 2.0 : 0.0).eval();
  };
  std::vector<LitTriangleRgb> out;
  append_edged(patch_of(f), f, Eigen::Array3d::Constant(1e-3), 6, out);
  const double exact = 2.0 * 0.5 * 0.5 * 5.0 / 7.0;
  EXPECT_NEAR(total(out, 0), exact, 0.01 * exact);
  EXPECT_GT(out.size(), 8U);
  EXPECT_LT(out.size(), 64U);  // parts that are all dark or lit are not cut further
}

TEST(LitLayer, DarkIsLeftOutByChannel) {
  const PointIrradiance f = [](const Eigen::Vector3d&) { return Eigen::Array3d(0.0, 1.0, 2.0); };
  EXPECT_TRUE(channel_light({patch_of(f)}, 0, 1).lit.empty());
  EXPECT_EQ(channel_light({patch_of(f)}, 1, 1).lit.size(), 1U);
  EXPECT_NEAR(channel_light({patch_of(f)}, 2, 1).patch_power_sr[0], 1.0, 1e-12);
}

}  // namespace
}  // namespace scattermeter
