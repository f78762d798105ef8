#include "core/mesh/surface_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/round_bodies.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

// Of the corners and the centre.
std::vector<Eigen::Vector3d> points_of(const TriangleMesh& mesh, int f) {
  const auto& t = mesh.triangles[static_cast<std::size_t>(f)];
  std::vector<Eigen::Vector3d> out;
  for (const int v : t) out.push_back(mesh.vertices_mm[static_cast<std::size_t>(v)]);
  out.push_back((out[0] + out[1] + out[2]) / 3.0);
  return out;
}

int facets(const TriangleMesh& mesh) { return static_cast<int>(mesh.triangles.size()); }

void expect_flat(const TriangleMesh& mesh) {
  const SurfaceNormals normals(mesh);
  EXPECT_FALSE(normals.any_curved());
  for (int f = 0; f < facets(mesh); ++f) {
    EXPECT_TRUE(normals.change_per_mm(f).isZero(0.0));
    for (const Eigen::Vector3d& p : points_of(mesh, f)) {
      EXPECT_EQ(normals.at(f, p), normals.of_facet(f));
    }
  }
}

TEST(SurfaceNormals, OfASphereLeadAwayFromItsCentre) {
  const TriangleMesh sphere = sphere_mesh(4);
  const SurfaceNormals normals(sphere);
  EXPECT_TRUE(normals.any_curved());
  double most_off = 0.0;
  for (int f = 0; f < facets(sphere); ++f) {
    const Eigen::Vector3d& n = normals.of_facet(f);
    const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - n * n.transpose();
    EXPECT_LT((normals.change_per_mm(f) - along / 10.0).norm(), 1e-9);
    for (const Eigen::Vector3d& p : points_of(sphere, f)) {
      const Eigen::Vector3d radial = (p - Eigen::Vector3d(0, 0, 10)).normalized();
      EXPECT_LT((normals.at(f, p) - radial).norm(), 1e-9);
      most_off = std::max(most_off, (n - radial).norm());
    }
  }
  EXPECT_GT(most_off, 0.02);  // the facet's own
}

TEST(SurfaceNormals, OfACylinderTurnAcrossItsAxis) {
  const TriangleMesh cylinder = cylinder_mesh(96);
  const SurfaceNormals normals(cylinder);
  for (int f = 0; f < facets(cylinder); ++f) {
    const Eigen::Vector3d& n = normals.of_facet(f);
    const Eigen::Matrix3d change = normals.change_per_mm(f);
    EXPECT_LT((change * Eigen::Vector3d::UnitZ()).norm(), 1e-9);
    if (std::abs(n.z()) > 0.5) {
      EXPECT_TRUE(change.isZero(0.0));
      continue;
    }
    const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(n);
    EXPECT_NEAR(across.dot(change * across), 0.1, 1e-3);
    for (Eigen::Vector3d p : points_of(cylinder, f)) {
      p.z() = 0.0;
      EXPECT_LT((normals.at(f, p) - p.normalized()).norm(), 1e-3);
    }
  }
}

TEST(SurfaceNormals, OfFacesAreTheirOwn) {
  for (const TriangleMesh& mesh : {test_support::make_cube(), test_support::make_pyramid(8, 13)}) {
    expect_flat(cut_finer(mesh, 2));
  }
}

// Twelve sides are a shape of their own, not a curve, and so are 80 facets.
TEST(SurfaceNormals, LargeFacetsAreFaces) {
  for (const TriangleMesh& mesh : {cylinder_mesh(12), sphere_mesh(1)}) expect_flat(mesh);
}

// A prism of five sides, of which two, a tenth of a millimetre wide, round off an edge by steps of
// eight degrees: the faces beside them stay flat, the narrow sides are curved.
TEST(SurfaceNormals, ARoundedEdgeDoesNotBendTheFacesBesideIt) {
  constexpr double kStep = 8.0 * std::numbers::pi / 180.0;
  std::vector<Eigen::Vector2d> outline = {{-10, 0}, {0, 0}};
  for (const int i : {1, 2}) {
    outline.emplace_back(outline.back() +
                         0.1 * Eigen::Vector2d(std::cos(i * kStep), std::sin(i * kStep)));
  }
  outline.emplace_back(outline.back() +
                       10.0 * Eigen::Vector2d(std::cos(3 * kStep), std::sin(3 * kStep)));
  outline.emplace_back(-5, 15);
  const TriangleMesh prism = test_support::make_prism(outline, 10);
  const SurfaceNormals normals(prism);
  int curved = 0;
  for (int f = 0; f < facets(prism); ++f) {
    const bool is_curved = !normals.change_per_mm(f).isZero(0.0);
    curved += is_curved ? 1 : 0;
    if (!is_curved) continue;
    const auto p = points_of(prism, f);
    const double narrowest_mm =
        std::min({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
    EXPECT_NEAR(narrowest_mm, 0.1, 1e-9);
  }
  EXPECT_EQ(curved, 4);
}

}  // namespace
}  // namespace scattermeter
