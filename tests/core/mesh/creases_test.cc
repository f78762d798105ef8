#include "core/mesh/creases.h"

#include <numbers>

#include <gtest/gtest.h>

#include "core/mesh/bodies.h"
#include "core/mesh/round_bodies.h"

namespace scattermeter {
namespace {

// The diagonals of its faces are none.
TEST(Creases, AreTheEdgesOfACube) {
  EXPECT_EQ(creases(cube_mesh(), 0.3).size(), 12U);
  for (const Crease& c : creases(cube_mesh(), 0.3)) {
    EXPECT_NEAR((c.to_mm - c.from_mm).norm(), 20.0, 1e-9);
  }
  EXPECT_TRUE(creases(cube_mesh(), 0.51 * std::numbers::pi).empty());
}

// A file may list the corners of each facet anew.
TEST(Creases, OfFacetsThatShareNoVertices) {
  const TriangleMesh cube = cube_mesh();
  TriangleMesh apart;
  for (const auto& t : cube.triangles) {
    const int first = static_cast<int>(apart.vertices_mm.size());
    for (const int v : t)
      apart.vertices_mm.push_back(cube.vertices_mm[static_cast<std::size_t>(v)]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(creases(apart, 0.3).size(), 12U);
}

TEST(Creases, ASphereHasNone) { EXPECT_TRUE(creases(body_mesh("sphere"), 0.3).empty()); }

TEST(Creases, ASphereIsRoundAndACubeIsNot) {
  EXPECT_TRUE(is_round(sphere_mesh()));
  EXPECT_FALSE(is_round(cube_mesh()));
}

}  // namespace
}  // namespace scattermeter
