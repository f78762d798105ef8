#include "core/mesh/convexity.h"

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

TEST(Convexity, HoldsForFlatFacesAndSpheres) {
  EXPECT_TRUE(is_convex(test_support::make_cube()));
  EXPECT_TRUE(is_convex(cut_finer(test_support::make_cube(), 3)));
  EXPECT_TRUE(is_convex(test_support::make_pyramid(8, 13)));
  EXPECT_TRUE(is_convex(test_support::make_sphere(10, 5)));
}

TEST(Convexity, HoldsWhereFilesRepeatVertices) {
  TriangleMesh apart;
  const TriangleMesh sphere = test_support::make_sphere(10, 2);
  for (const auto& t : sphere.triangles) {
    const int n = static_cast<int>(apart.vertices_mm.size());
    for (int i : t) apart.vertices_mm.push_back(sphere.vertices_mm[static_cast<std::size_t>(i)]);
    apart.triangles.push_back({n, n + 1, n + 2});
  }
  EXPECT_TRUE(is_convex(apart));
}

// One vertex of thousands a little too low or, in a flat face, too high.
TEST(Convexity, FailsForADent) {
  TriangleMesh sphere = test_support::make_sphere(10, 4);
  sphere.vertices_mm[500] *= 0.99;
  EXPECT_FALSE(is_convex(sphere));
  TriangleMesh cube = cut_finer(test_support::make_cube(), 3);
  for (Eigen::Vector3d& v : cube.vertices_mm) {
    if (v.z() == 20.0 && v.head<2>().norm() < 6.0) v.z() += 0.01;
  }
  EXPECT_FALSE(is_convex(cube));
}

// Convex each, not together.
TEST(Convexity, FailsForTwoPieces) {
  TriangleMesh two = test_support::make_cube();
  const TriangleMesh other = test_support::make_box({30, 0, 0}, {40, 10, 10});
  const int n = static_cast<int>(two.vertices_mm.size());
  two.vertices_mm.insert(two.vertices_mm.end(), other.vertices_mm.begin(), other.vertices_mm.end());
  for (const auto& t : other.triangles) two.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  EXPECT_FALSE(is_convex(two));
}

}  // namespace
}  // namespace scattermeter
