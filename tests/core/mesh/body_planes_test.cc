#include "core/mesh/body_planes.h"

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

TEST(BodyPlanes, ABoxHasSixHoweverManyItsTriangles) {
  for (int levels : {0, 3}) {
    const TriangleMesh box = cut_finer(test_support::make_cube(), levels);
    const BodyPlanes body = body_planes(box, 32);
    ASSERT_EQ(body.planes.size(), 6U);
    EXPECT_TRUE(body.convex);
    ASSERT_EQ(body.plane_of_facet.size(), box.triangles.size());
    for (const BodyPlane& p : body.planes) {
      EXPECT_EQ(p.facets.size(), box.triangles.size() / 6);
      EXPECT_NEAR(p.depth_mm({0, 0, 10}), 10.0, 1e-12);  // of the centre
      EXPECT_NEAR(p.box.size_mm().sum(), 40.0, 1e-12);   // flat
      EXPECT_NEAR(p.depth_mm(p.box.center_mm()), 0.0, 1e-12);
    }
  }
}

TEST(BodyPlanes, KnowsConvexFromConcave) {
  EXPECT_TRUE(body_planes(test_support::make_pyramid(8, 13), 32).convex);
  // A box whose top is pushed in to a point: four planes slope inwards.
  TriangleMesh bowl = test_support::make_cube();
  bowl.vertices_mm.emplace_back(0, 0, 12);
  const int tip = 8;
  bowl.triangles.erase(bowl.triangles.begin() + 2, bowl.triangles.begin() + 4);
  for (const auto& [a, b] : {std::pair{4, 5}, {5, 7}, {7, 6}, {6, 4}}) {
    bowl.triangles.push_back({a, b, tip});
  }
  ASSERT_EQ(mesh_problem(bowl), "");
  const BodyPlanes body = body_planes(bowl, 32);
  EXPECT_EQ(body.planes.size(), 9U);
  EXPECT_FALSE(body.convex);
}

TEST(BodyPlanes, GivesUpOnMany) {
  const BodyPlanes body = body_planes(test_support::make_sphere(10, 2), 32);
  EXPECT_TRUE(body.planes.empty());
  EXPECT_TRUE(body.plane_of_facet.empty());
  EXPECT_FALSE(body.convex);
}

}  // namespace
}  // namespace scattermeter
