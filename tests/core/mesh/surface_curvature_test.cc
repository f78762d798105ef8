#include "core/mesh/surface_curvature.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/mesh/round_bodies.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

// About z, from z = 0 to 20; the facets in the order bottom, top, two of the side.
TriangleMesh many_sided(int sides, double radius_mm) {
  TriangleMesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {0, 0, 20}};
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    for (const double z : {0.0, 20.0}) {
      mesh.vertices_mm.emplace_back(radius_mm * std::cos(angle), radius_mm * std::sin(angle), z);
    }
    const int low = 2 + 2 * i, next = 2 + 2 * ((i + 1) % sides);
    mesh.triangles.push_back({0, next, low});
    mesh.triangles.push_back({1, low + 1, next + 1});
    mesh.triangles.push_back({low, next, next + 1});
    mesh.triangles.push_back({low, next + 1, low + 1});
  }
  return mesh;
}

Eigen::Vector3d normal_of(const TriangleMesh& mesh, std::size_t f) {
  return area_vector_mm2(mesh, static_cast<int>(f)).normalized();
}

TEST(SurfaceCurvature, OfASphereIsOneOverItsRadius) {
  const TriangleMesh sphere = sphere_mesh(4);
  const auto turns = normal_change_per_mm(sphere);
  ASSERT_EQ(turns.size(), sphere.triangles.size());
  for (std::size_t f = 0; f < turns.size(); ++f) {
    const Eigen::Vector3d n = normal_of(sphere, f);
    const Eigen::Matrix3d along = Eigen::Matrix3d::Identity() - n * n.transpose();
    EXPECT_LT((turns[f] - along / 10.0).norm(), 0.005);
  }
}

TEST(SurfaceCurvature, OfACylinderIsAcrossItsAxis) {
  const TriangleMesh cylinder = many_sided(96, 10.0);
  const auto turns = normal_change_per_mm(cylinder);
  for (std::size_t f = 0; f < turns.size(); ++f) {
    const Eigen::Vector3d n = normal_of(cylinder, f);
    EXPECT_LT((turns[f] * Eigen::Vector3d::UnitZ()).norm(), 1e-9);
    if (std::abs(n.z()) > 0.5) {
      EXPECT_TRUE(turns[f].isZero(0.0));
    } else {
      const Eigen::Vector3d across = Eigen::Vector3d::UnitZ().cross(n);
      EXPECT_NEAR(across.dot(turns[f] * across), 0.1, 1e-3);
    }
  }
}

TEST(SurfaceCurvature, OfFacesIsZero) {
  for (const TriangleMesh& mesh : {test_support::make_cube(), test_support::make_pyramid(8, 13)}) {
    for (const auto& turn : normal_change_per_mm(cut_finer(mesh, 2))) {
      EXPECT_TRUE(turn.isZero(0.0));
    }
  }
}

// Twelve sides are a shape of their own, not a curve, and so are 80 facets.
TEST(SurfaceCurvature, LargeFacetsAreFaces) {
  for (const TriangleMesh& mesh : {many_sided(12, 10.0), sphere_mesh(1)}) {
    for (const auto& turn : normal_change_per_mm(mesh)) EXPECT_TRUE(turn.isZero(0.0));
  }
}

}  // namespace
}  // namespace scattermeter
