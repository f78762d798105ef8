#include "core/mesh/facet_visibility.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/random_stream.h"
#include "core/mesh/ray_scene.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/bumps.h"

namespace scattermeter {
namespace {

// Places on facets that are called seen are seen, by rays; `least`: so many of the facets that face
// the camera are.
void expect_seen(const TriangleMesh& mesh, const Eigen::Vector3d& camera, double least) {
  const RayScene scene(mesh);
  const std::vector<bool> seen = surely_seen(mesh, camera);
  ASSERT_EQ(seen.size(), mesh.triangles.size());
  RandomStream random(1, 0);
  int facing = 0;
  int n_seen = 0;
  for (std::size_t f = 0; f < seen.size(); ++f) {
    const auto& t = mesh.triangles[f];
    const auto corner = [&](std::size_t i) {
      return mesh.vertices_mm[static_cast<std::size_t>(t[i])];
    };
    const Eigen::Vector3d normal = area_vector_mm2(mesh, static_cast<int>(f)).normalized();
    if (!(normal.dot(camera - corner(0)) > 0.0)) {
      EXPECT_FALSE(seen[f]);
      continue;
    }
    ++facing;
    if (!seen[f]) continue;
    ++n_seen;
    for (int i = 0; i < 20; ++i) {
      const double u = std::sqrt(random.uniform());
      const double v = random.uniform();
      const Eigen::Vector3d x =
          (1.0 - u) * corner(0) + u * (1.0 - v) * corner(1) + u * v * corner(2);
      EXPECT_FALSE(scene.occluded(x, normal, camera)) << f;
    }
  }
  EXPECT_GE(n_seen, least * facing) << facing;
}

TEST(FacetVisibility, NothingHidesAConvexBodysFacets) {
  expect_seen(test_support::make_sphere(10, 4), {0, -100, 150}, 0.85);
  expect_seen(test_support::make_sphere(10, 4), {1e4, 0, 0}, 0.85);
  expect_seen(cut_finer(test_support::make_cube(), 3), {0, -100, 150}, 0.5);
}

TEST(FacetVisibility, NeverCallsAHiddenFacetSeen) {
  const TriangleMesh bumps = test_support::make_bumps(10, 0.4, 5);
  for (const Eigen::Vector3d& camera :
       {Eigen::Vector3d(0, -100, 150), Eigen::Vector3d(25, 0, 5), Eigen::Vector3d(-3, 4000, 0)}) {
    expect_seen(bumps, camera, 0.3);
  }
}

TEST(FacetVisibility, LeavesAllToRaysFromNearby) {
  const std::vector<bool> seen = surely_seen(test_support::make_sphere(10, 3), {0, 0, 10.5});
  EXPECT_EQ(std::count(seen.begin(), seen.end(), true), 0);
}

}  // namespace
}  // namespace scattermeter
