#include "apps/checking/edge_rows.h"

#include <gtest/gtest.h>

#include "core/mesh/bodies.h"

namespace scattermeter::apps {
namespace {

TEST(EdgeRows, BesideTheEdgesOfACube) {
  const std::vector<Eigen::Vector3d> points = {
      {0, 0, 20}, {9.5, 0, 20}, {8.5, 0, 20}, {10, 9.2, 5}, {10, 0, 10}};
  EXPECT_EQ(beside_edges(cube_mesh(), points, 1.0),
            (std::vector<bool>{false, true, false, true, false}));
}

// The diagonals of its faces and the facets of a sphere are no edges.
TEST(EdgeRows, NotOnSmoothSurfaces) {
  const TriangleMesh sphere = body_mesh("sphere");
  for (const bool beside : beside_edges(sphere, sphere.vertices_mm, 1.0)) EXPECT_FALSE(beside);
}

}  // namespace
}  // namespace scattermeter::apps
