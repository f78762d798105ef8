#include "core/mesh/patch_mesh.h"

#include <random>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/mesh/triangle_parts.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

TEST(PatchMesh, KeepsAreaAndBounds) {
  for (double size : {0.3, 0.77, 5.0, 100.0}) {
    const TriangleMesh mesh = test_support::make_pyramid(8, 13);
    const PatchMesh patches(mesh, size);
    double area = 0.0, expected = 0.0;
    for (int k = 0; k < patches.size(); ++k) {
      area += patches.area_mm2(k);
      EXPECT_LE(patches.area_mm2(k), size * size * (1 + 1e-12));
      EXPECT_LE(longest_edge_mm(patches.corners_mm(k)), 2.5 * size * (1 + 1e-12));
    }
    for (int t = 0; t < 6; ++t) expected += area_vector_mm2(mesh, t).norm();
    EXPECT_NEAR(area, expected, 1e-9);
  }
}

// Needles keep to the limits and do not explode: bisection leaves about 3^n of them for n halvings.
TEST(PatchMesh, CutsNeedlesWithinBounds) {
  const PatchMesh patches(test_support::make_box({0, 0, 0}, {100, 0.5, 0.5}), 0.5);
  for (int k = 0; k < patches.size(); ++k)
    EXPECT_LE(longest_edge_mm(patches.corners_mm(k)), 1.25 + 1e-12);
  EXPECT_LT(patches.size(), 20'000);
}

// The patch found for a point holds it, and the barycentric weights give the point back.
TEST(PatchMesh, LocatesPoints) {
  const TriangleMesh mesh = test_support::make_cube();
  const PatchMesh patches(mesh, 0.6);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  for (int i = 0; i < 2000; ++i) {
    const int facet = i % 12;
    double u = uniform(random), v = uniform(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    if (i < 24) u = 0.5, v = i < 12 ? 0.5 : 0.0;  // on edges
    const auto& t = mesh.triangles[static_cast<std::size_t>(facet)];
    const Eigen::Vector3d p = (1 - u - v) * mesh.vertices_mm[static_cast<std::size_t>(t[0])] +
                              u * mesh.vertices_mm[static_cast<std::size_t>(t[1])] +
                              v * mesh.vertices_mm[static_cast<std::size_t>(t[2])];
    const PatchPoint at = patches.locate(facet, {1 - u - v, u, v});
    ASSERT_GE(at.patch_idx, 0);
    ASSERT_LT(at.patch_idx, patches.size());
    EXPECT_EQ(patches.facet_idx(at.patch_idx), facet);
    EXPECT_GE(at.barycentric.minCoeff(), -1e-12);
    const auto c = patches.corners_mm(at.patch_idx);
    const Eigen::Vector3d back =
        at.barycentric[0] * c[0] + at.barycentric[1] * c[1] + at.barycentric[2] * c[2];
    EXPECT_LT((back - p).norm(), 1e-12);
  }
}

// Along a line over two facets and from one patch's vertex to the next, as locate() does.
TEST(PatchMesh, FindsThePatchesOfNeighbouringPoints) {
  const PatchMesh patches(test_support::make_cube(), 0.6);
  PatchMesh::Finder finder(patches);
  int last = -1, changes = 0;
  for (int i = 0; i <= 4000; ++i) {
    const int facet = i / 2001;
    const double u = (i % 2001) / 2000.0, v = (1 - u) * 0.3;
    const Eigen::Vector3d weights{1 - u - v, u, v};
    const int patch = finder.patch_idx(facet, weights);
    ASSERT_EQ(patch, patches.locate(facet, weights).patch_idx) << i;
    changes += patch != last ? 1 : 0;
    last = patch;
  }
  EXPECT_GT(changes, 10);
}

TEST(PatchMesh, PatchesKeepTheFacetsNormal) {
  const PatchMesh patches(test_support::make_cube(), 1.0);
  for (int k = 0; k < patches.size(); ++k) {
    const auto c = patches.corners_mm(k);
    const Eigen::Vector3d n = (c[1] - c[0]).cross(c[2] - c[0]).normalized();
    EXPECT_LT((n - patches.normal(k)).norm(), 1e-12);
  }
}

TEST(PatchMesh, RefusesSizesThatMakeNoSense) {
  EXPECT_THROW(PatchMesh(test_support::make_cube(), 0.0), std::invalid_argument);
  EXPECT_THROW(PatchMesh(test_support::make_cube(), -1.0), std::invalid_argument);
  EXPECT_THROW(PatchMesh(test_support::make_cube(), 0.1, 1000), std::length_error);
}

}  // namespace
}  // namespace scattermeter
