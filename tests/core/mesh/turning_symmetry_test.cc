#include "core/mesh/turning_symmetry.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/mesh/bodies.h"
#include "core/mesh/round_bodies.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

Eigen::Matrix3d of(const TriangleMesh& mesh) {
  return displacing_turns(mesh, bounds(mesh).center_mm());
}

TEST(TurningSymmetry, NoTurnDisplacesASphereAboutItsCentre) {
  for (const int levels : {3, 4, 6}) EXPECT_TRUE(of(sphere_mesh(levels)).isZero(0.0)) << levels;
}

TEST(TurningSymmetry, ASphereAboutAnotherPointMoves) {
  const Eigen::Vector3d beside_mm = Eigen::Vector3d(0, 0, 12);
  // 2 mm above the centre: not by turns about the line through both.
  const Eigen::Vector3d expected(1, 1, 0);
  EXPECT_LT(
      (displacing_turns(sphere_mesh(4), beside_mm) - Eigen::Matrix3d(expected.asDiagonal())).norm(),
      1e-2);
}

TEST(TurningSymmetry, ACylinderTurnsAboutItsAxis) {
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  for (const int sides : {60, 288}) {
    TriangleMesh mesh = cylinder_mesh(sides);
    for (Eigen::Vector3d& v : mesh.vertices_mm) {
      v = turned * (v - Eigen::Vector3d(0, 0, 10)) + Eigen::Vector3d(3, -4, 50);
    }
    const Eigen::Vector3d axis = turned.col(2);
    const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - axis * axis.transpose();
    EXPECT_LT((displacing_turns(mesh, {3, -4, 50}) - across).norm(), 1e-6) << sides;
  }
}

TEST(TurningSymmetry, AllTurnsDisplaceOtherBodies) {
  for (const TriangleMesh& mesh : {test_support::make_cube(), pyramid_mesh(), cylinder_mesh(12),
                                   sphere_mesh(0), scanned_mesh()}) {
    EXPECT_EQ(of(mesh), Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  }
}

}  // namespace
}  // namespace scattermeter
