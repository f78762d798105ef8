#include "core/mesh/clearance_grid.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "core/base/random_stream.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

// Never more than the distance to the surface, never less by three diagonals of a cell.
template <class Distance>
void expect_bound(const TriangleMesh& mesh, const Distance& distance_mm) {
  constexpr int kCells = 40;
  const ClearanceGrid grid(mesh, kCells);
  const Box3d box = bounds(mesh);
  const double slack_mm = 3.0 * std::sqrt(3.0) * box.size_mm().maxCoeff() / kCells;
  RandomStream random(1, 0);
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d x =
        box.min_mm + Eigen::Vector3d(random.uniform(), random.uniform(), random.uniform())
                         .cwiseProduct(box.size_mm());
    const double d = distance_mm(x);
    if (d < 0.0) continue;
    ASSERT_LE(grid.at(x), d);
    ASSERT_GE(grid.at(x), d - slack_mm);
  }
}

TEST(ClearanceGrid, BoundsTheDistanceInABox) {
  expect_bound(test_support::make_cube(), [](const Eigen::Vector3d& x) {
    return std::min({10.0 - std::abs(x.x()), 10.0 - std::abs(x.y()), x.z(), 20.0 - x.z()});
  });
}

// Slanted facets, large and small.
TEST(ClearanceGrid, BoundsTheDistanceInPyramidAndSphere) {
  const double slope = std::atan2(13.0, 8.0);
  expect_bound(test_support::make_pyramid(8, 13), [&](const Eigen::Vector3d& x) {
    const double side = std::max(std::abs(x.x()), std::abs(x.y()));
    return std::min(x.z(), (8.0 - side) * std::sin(slope) - x.z() * std::cos(slope));
  });
  // The facets lie up to 0.004 mm inside the sphere.
  expect_bound(test_support::make_sphere(10, 5), [](const Eigen::Vector3d& x) {
    return x.norm() < 9.9 ? 10.0 - x.norm() - 0.005 : -1.0;
  });
}

TEST(ClearanceGrid, IsNegativeBeyond) {
  const ClearanceGrid grid(test_support::make_cube(), 10);
  EXPECT_LT(grid.at({0, 0, 25}), 0.0);
  EXPECT_LT(grid.at({-15, 0, 5}), 0.0);
  EXPECT_THROW(ClearanceGrid(test_support::make_cube(), 0), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
