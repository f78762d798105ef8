#include "core/view/pixel_points.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "tests/fixtures/core/pinhole_rays.h"

namespace scattermeter {
namespace {

constexpr double kFocal_px = 1000.0;
const RayGrid& grid() {
  static const RayGrid rays = test_support::pinhole_rays({0, -100, 0}, {0, 0, 0}, kFocal_px, 9, 9);
  return rays;
}

// In pixels, from the middle of the grid: the camera looks along y, with x to the right.
Eigen::Vector2d position_px(const Eigen::Vector3d& direction) {
  return {kFocal_px * direction.x() / direction.y(), -kFocal_px * direction.z() / direction.y()};
}

TEST(PixelPoints, FillThePixelWithoutSharingRowsOrColumns) {
  for (const int n : {16, 64}) {
    const PixelPoints pixel(grid(), 4, 4);
    std::set<int> columns, rows;
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector2d at = position_px(pixel.direction(i, n));
      EXPECT_LT(at.cwiseAbs().maxCoeff(), 0.5);
      columns.insert(static_cast<int>(std::floor((at.x() + 0.5) * n)));
      rows.insert(static_cast<int>(std::floor((at.y() + 0.5) * n)));
    }
    EXPECT_EQ(columns.size(), static_cast<std::size_t>(n));
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(n));
  }
}

// At the last row and column the differences are taken backwards.
TEST(PixelPoints, LieInTheirPixelInEveryCorner) {
  for (const int x : {0, 8}) {
    for (const int y : {0, 8}) {
      const PixelPoints pixel(grid(), x, y);
      for (int i = 0; i < 16; ++i) {
        const Eigen::Vector2d at = position_px(pixel.direction(i, 16));
        EXPECT_LT((at - Eigen::Vector2d(x - 4, y - 4)).cwiseAbs().maxCoeff(), 0.5);
      }
    }
  }
}

TEST(PixelPoints, SolidAngleOfThePixelInTheMiddle) {
  EXPECT_NEAR(PixelPoints(grid(), 4, 4).solid_angle_sr(), 1.0 / (kFocal_px * kFocal_px), 1e-10);
}

}  // namespace
}  // namespace scattermeter
