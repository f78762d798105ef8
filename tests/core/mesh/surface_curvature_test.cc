#include "core/mesh/surface_curvature.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/mesh/round_bodies.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

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
    EXPECT_LT((turns[f] - along / 10.0).norm(), 1e-9);
  }
}

TEST(SurfaceCurvature, OfACylinderIsAcrossItsAxis) {
  const TriangleMesh cylinder = cylinder_mesh(96);
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
  for (const TriangleMesh& mesh : {cylinder_mesh(12), sphere_mesh(1)}) {
    for (const auto& turn : normal_change_per_mm(mesh)) EXPECT_TRUE(turn.isZero(0.0));
  }
}

}  // namespace
}  // namespace scattermeter
