#include "core/mesh/ray_scene.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

// Every ray toward the inside of a closed box hits it at the distance of the slab test, the whole
// scene also a kilometre from the origin.
TEST(RayScene, HitsTheBoxWhereTheSlabTestSays) {
  for (const Eigen::Vector3d& offset :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e6, -2e5, 3e5)}) {
    TriangleMesh cube = test_support::make_cube();
    for (auto& v : cube.vertices_mm) v += offset;
    const RayScene scene(cube);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> inside(-9.9, 9.9);
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector3d from =
          200.0 * Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
      const Eigen::Vector3d to(inside(random), inside(random), inside(random) + 10.0);
      const Eigen::Vector3d d = to - from;
      const Eigen::Vector3d low = (Eigen::Vector3d(-10, -10, 0) - from).cwiseQuotient(d);
      const Eigen::Vector3d high = (Eigen::Vector3d(10, 10, 20) - from).cwiseQuotient(d);
      const double expected = low.cwiseMin(high).maxCoeff();
      const RayHit hit = scene.first_hit(from + offset, d);
      ASSERT_GE(hit.facet_idx, 0);
      EXPECT_NEAR(hit.distance * d.norm(), expected * d.norm(), 2e-4);
      // The barycentric point is the ray's point.
      const auto& t = cube.triangles[static_cast<std::size_t>(hit.facet_idx)];
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      for (int j = 0; j < 3; ++j) {
        p += hit.barycentric[j] * (cube.vertices_mm[static_cast<std::size_t>(t[j])] - offset);
      }
      EXPECT_LT((p - (from + expected * d)).norm(), 2e-4);
    }
  }
}

// Rays aimed exactly at edges and corners find no gap.
TEST(RayScene, HasNoGapsAtEdges) {
  const RayScene scene(test_support::make_cube());
  std::mt19937 random(6);
  std::uniform_real_distribution<double> t(-10.0, 10.0);
  for (int i = 0; i < 2000; ++i) {
    const double s = t(random);
    for (const Eigen::Vector3d& on_edge :
         {Eigen::Vector3d(s, 0, 20), Eigen::Vector3d(s, s, 20), Eigen::Vector3d(s, -10, 10 + s)}) {
      const Eigen::Vector3d from(3.3, -70, 90);
      EXPECT_GE(scene.first_hit(from, on_edge - from).facet_idx, 0);
    }
  }
}

// Side by side rays meet what each meets by itself, also those through edges and beside the object.
TEST(RayScene, ManyRaysAreTheSame) {
  const RayScene scene(test_support::make_cube());
  const Eigen::Vector3d from(33, -170, 90);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-12.0, 12.0);
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < 1003; ++i) {
    const Eigen::Vector3d to(x(random), i % 3 == 0 ? -10 : x(random), i % 5 == 0 ? 20 : x(random));
    directions.emplace_back((to - from).cast<float>());
    if (i % 7 == 0) directions.back().y() = std::nanf("");
  }
  std::vector<RayHit> hits(directions.size(), RayHit{5, Eigen::Vector3d::Zero(), 1.0});
  scene.first_hits(from, directions, hits);
  int on = 0;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!directions[i].allFinite()) {
      EXPECT_EQ(hits[i].facet_idx, -1) << i;
      continue;
    }
    const RayHit one = scene.first_hit(from, directions[i].cast<double>());
    ASSERT_EQ(hits[i].facet_idx < 0, one.facet_idx < 0) << i;
    if (one.facet_idx < 0) continue;
    ++on;
    // Of an edge either facet will do.
    EXPECT_NEAR(hits[i].distance, one.distance, 1e-6) << i;
    if (hits[i].facet_idx == one.facet_idx) {
      EXPECT_LT((hits[i].barycentric - one.barycentric).norm(), 1e-5) << i;
    }
  }
  EXPECT_GT(on, 300);
}

TEST(RayScene, MissesWhatIsBeside) {
  const RayScene scene(test_support::make_cube());
  EXPECT_EQ(scene.first_hit({0, 0, 100}, {0, 0, 1}).facet_idx, -1);
  EXPECT_EQ(scene.first_hit({10.01, 0, 100}, {0, 0, -1}).facet_idx, -1);
}

TEST(RayScene, ShadowOfAPyramidOnItsPedestal) {
  // A wall beside a floor in one body: an L from two boxes' outline is not needed, a pyramid's own
  // far side is dark, its near side lit, and a convex body never shadows a facet that faces the
  // light.
  const TriangleMesh mesh = test_support::make_pyramid(8, 13);
  const RayScene scene(mesh);
  const Eigen::Vector3d led(40, 0, 30);
  for (int f = 0; f < 6; ++f) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(f)];
    const Eigen::Vector3d n = area_vector_mm2(mesh, f).normalized();
    const Eigen::Vector3d p = (mesh.vertices_mm[static_cast<std::size_t>(t[0])] +
                               mesh.vertices_mm[static_cast<std::size_t>(t[1])] +
                               mesh.vertices_mm[static_cast<std::size_t>(t[2])]) /
                              3.0;
    EXPECT_EQ(scene.occluded(p, n, led), n.dot(led - p) <= 0.0) << "facet " << f;
  }
}

TEST(RayScene, KnowsInsideFromOutside) {
  const RayScene scene(test_support::make_cube());
  EXPECT_TRUE(scene.contains({0, 0, 10}));
  EXPECT_TRUE(scene.contains({9.99, 9.99, 0.01}));
  EXPECT_FALSE(scene.contains({10.01, 0, 10}));
  EXPECT_FALSE(scene.contains({0, 0, 1000}));
}

}  // namespace
}  // namespace scattermeter
