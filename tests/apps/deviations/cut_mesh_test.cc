#include "apps/deviations/cut_mesh.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/mesh/bodies.h"
#include "core/mesh/round_bodies.h"

namespace scattermeter::apps {
namespace {

TEST(CutMesh, HalfCube) {
  const TriangleMesh half = cut_mesh(cube_mesh(), Eigen::Vector3d::UnitX(), 3.0);
  EXPECT_EQ(mesh_problem(half), "");
  EXPECT_NEAR(signed_volume_mm3(half), 13.0 * 20 * 20, 1e-6);
  EXPECT_NEAR(bounds(half).max_mm.x(), 3.0, 1e-12);
}

TEST(CutMesh, PlaneThatMissesOrTakesAll) {
  const TriangleMesh whole = cut_mesh(cube_mesh(), Eigen::Vector3d::UnitX(), 11.0);
  EXPECT_NEAR(signed_volume_mm3(whole), 8000.0, 1e-9);
  EXPECT_NEAR(signed_volume_mm3(cut_mesh(cube_mesh(), Eigen::Vector3d::UnitX(), 10.0)), 8000.0,
              1e-9);
  EXPECT_THROW(cut_mesh(cube_mesh(), Eigen::Vector3d::UnitX(), -11.0), std::invalid_argument);
}

// Three edges of the cube's corner at equal distances: a tetrahedron of depth^3 sqrt(3) / 2 is
// gone.
TEST(CutMesh, ChippedCorner) {
  const double depth_mm = 2.0;
  const TriangleMesh chipped =
      chipped_mesh(cube_mesh(), Eigen::Vector3d(1, -1, 1).normalized(), depth_mm);
  EXPECT_EQ(mesh_problem(chipped), "");
  EXPECT_NEAR(signed_volume_mm3(chipped), 8000.0 - std::pow(depth_mm, 3) * std::sqrt(3.0) / 2.0,
              1e-6);
}

// A cap of height h of a sphere of radius r has the volume pi h^2 (r - h / 3).
TEST(CutMesh, ChippedSphere) {
  const TriangleMesh ball = sphere_mesh();
  const TriangleMesh chipped = chipped_mesh(ball, Eigen::Vector3d(0.4, -0.5, 0.77).normalized(), 3);
  EXPECT_EQ(mesh_problem(chipped), "");
  EXPECT_NEAR(signed_volume_mm3(ball) - signed_volume_mm3(chipped), std::numbers::pi * 9 * (10 - 1),
              3.0);
}

// Along an edge a bevel of leg c takes a prism of c^2 / 2; in the cube c^3 of a corner the three
// prisms x + y < c, y + z < c, z + x < c cover 3/4.
TEST(CutMesh, BevelledCube) {
  for (const double leg_mm : {0.1, 0.4, 1.5}) {
    const TriangleMesh bevelled = bevelled_mesh(cube_mesh(), leg_mm);
    EXPECT_EQ(mesh_problem(bevelled), "") << leg_mm;
    const double c = leg_mm;
    EXPECT_NEAR(8000.0 - signed_volume_mm3(bevelled),
                12 * (20 - 2 * c) * c * c / 2 + 8 * 0.75 * c * c * c, 1e-3)
        << leg_mm;
    EXPECT_NEAR(bounds(bevelled).size_mm().x(), 20.0, 1e-9);
  }
}

TEST(CutMesh, BevelledPyramid) {
  for (const double leg_mm : {0.1, 0.4, 1.5}) {
    const TriangleMesh bevelled = bevelled_mesh(pyramid_mesh(), leg_mm);
    EXPECT_EQ(mesh_problem(bevelled), "") << leg_mm;
    EXPECT_LT(signed_volume_mm3(bevelled), signed_volume_mm3(pyramid_mesh()));
  }
}

}  // namespace
}  // namespace scattermeter::apps
