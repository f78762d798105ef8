#include "core/view/row_blur.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Rows 0.5 mm apart on the plane z = 0, from adjacent to adjacent.
struct Grid {
  static constexpr int kN = 5;
  std::vector<Eigen::Vector3d> centers_mm, normals;
  std::vector<std::vector<std::int32_t>> adjacent;

  Grid() {
    for (int y = 0; y < kN; ++y) {
      for (int x = 0; x < kN; ++x) {
        centers_mm.emplace_back(0.5 * x, 0.5 * y, 0.0);
        normals.push_back(Eigen::Vector3d::UnitZ());
        auto& list = adjacent.emplace_back();
        for (int v = std::max(0, y - 1); v <= std::min(kN - 1, y + 1); ++v) {
          for (int u = std::max(0, x - 1); u <= std::min(kN - 1, x + 1); ++u) {
            if (u != x || v != y) list.push_back(v * kN + u);
          }
        }
      }
    }
  }
  // Seen from far away, slanted by an angle about y.
  BlurredRows seen_at(double angle_rad) const {
    const Eigen::Vector3d to_camera(std::sin(angle_rad), 0.0, std::cos(angle_rad));
    Eigen::Matrix<double, 3, 2> axes;
    axes.col(0) = Eigen::Vector3d(std::cos(angle_rad), 0.0, -std::sin(angle_rad));
    axes.col(1) = Eigen::Vector3d(0.0, -1.0, 0.0);
    return {centers_mm, normals, adjacent, 1e7 * to_camera, axes};
  }
};

// l = a x^2 + b x y + c y^2.
Eigen::Matrix3Xd gradient_of(const Grid& grid, double a, double b, double c) {
  Eigen::Matrix3Xd out(3, static_cast<Eigen::Index>(grid.centers_mm.size()));
  for (Eigen::Index i = 0; i < out.cols(); ++i) {
    const Eigen::Vector3d& p = grid.centers_mm[static_cast<std::size_t>(i)];
    out.col(i) << 2.0 * a * p.x() + b * p.y(), b * p.x() + 2.0 * c * p.y(), 0.0;
  }
  return out;
}

// Half the second derivatives times the covariance; slanted, x on the surface is longer by
// 1 / cos.
TEST(RowBlur, ExactForQuadraticLight) {
  const Grid grid;
  const Eigen::Matrix3Xd gradient = gradient_of(grid, 0.7, 0.4, -0.3);
  const Eigen::Matrix2d spread{{0.03, 0.01}, {0.01, 0.02}};
  for (const double angle_rad : {0.0, 0.5, 1.2}) {
    const double longer = 1.0 / std::cos(angle_rad);
    const Eigen::VectorXd change = change_by_blur(grid.seen_at(angle_rad), gradient, spread);
    // Down in the picture is -y.
    const double expected = 0.7 * 0.03 * longer * longer - 0.4 * 0.01 * longer - 0.3 * 0.02;
    for (Eigen::Index i = 0; i < change.size(); ++i) {
      EXPECT_NEAR(change[i], expected, 1e-5 * std::abs(expected)) << i;
    }
  }
}

TEST(RowBlur, RowsAloneDoNotChange) {
  Grid grid;
  for (auto& list : grid.adjacent) list.clear();
  EXPECT_TRUE(change_by_blur(grid.seen_at(0.3), gradient_of(grid, 1.0, 1.0, 1.0),
                             Eigen::Matrix2d::Identity())
                  .isZero(0.0));
  EXPECT_THROW(
      change_by_blur(grid.seen_at(0.3), Eigen::Matrix3Xd(3, 4), Eigen::Matrix2d::Identity()),
      std::invalid_argument);
}

// Two rows of 10 x 20 samples, with a guard of four samples between them and two around.
SampleMap two_rows() {
  SampleMap map;
  map.width = 28;
  map.height = 24;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const bool inside = y >= 2 && y < 22;
      const int row = x >= 2 && x < 12 ? 0 : (x >= 16 && x < 26 ? 1 : -1);
      map.row_of_sample.push_back(inside ? row : -1);
    }
  }
  return map;
}

TEST(RowBlur, LeaksDependOnWhatIsBeside) {
  const SampleMap map = two_rows();
  for (const double leak : leaked_by_blur(map, {1.0, 1.0}, 0.4)) EXPECT_EQ(leak, 0.0);
  const std::vector<double> alike = leaked_by_blur(map, {1.0, 1.0}, 1.0);
  EXPECT_EQ(alike[0], alike[1]);
  // The outermost samples, 56 of 200, are 2.5 px from the edge; the next, 48, by a pixel more; then
  // 40 beyond which nothing counts.
  const auto beyond = [](double px) { return 0.5 * std::erfc(px * M_SQRT1_2); };
  EXPECT_NEAR(alike[0], (56.0 * beyond(2.5) + 48.0 * beyond(3.5)) / 200.0, 1e-12);
  const std::vector<double> beside_bright = leaked_by_blur(map, {1.0, 0.1}, 1.0);
  EXPECT_EQ(beside_bright[0], alike[0]);
  EXPECT_GT(beside_bright[1], 2.0 * alike[1]);
  EXPECT_LT(beside_bright[1], 10.0 * alike[1]);
  EXPECT_GT(leaked_by_blur(map, {1.0, 1.0}, 2.0)[0], 5.0 * alike[0]);
}

}  // namespace
}  // namespace scattermeter
