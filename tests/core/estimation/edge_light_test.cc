#include "core/estimation/edge_light.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/material/dipole.h"
#include "core/mesh/creases.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

// The edge between a top face and a side, under light of unit irradiance that comes from above,
// inclined towards the side by an angle. eta 1: the cosine alone.
double change(double angle_rad) {
  constexpr double kFar_mm = 1e6;
  Led led;
  led.exponent = 0.0;
  led.position_mm = kFar_mm * Eigen::Vector3d(std::sin(angle_rad), 0.0, std::cos(angle_rad));
  led.axis = -led.position_mm.normalized();
  const Crease edge{{0, 0, 0}, {0, 1, 0}, {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()}};
  return kFar_mm * kFar_mm * light_by_chamfer_per_mm(led, edge, {0, 0, 0}, 1.0);
}

TEST(EdgeLight, AChamferLosesWhatItCoversLess) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  // Both faces lit: their shadows on a plane across the light are that of the chamfer.
  EXPECT_NEAR(change(30.0 * kDegree), 0.0, 1e-6);
  EXPECT_NEAR(change(0.0), 0.0, 1e-6);
  // The side dark: the chamfer is more inclined than the top by what the side faces away.
  EXPECT_NEAR(change(-20.0 * kDegree), -std::sin(20.0 * kDegree), 1e-6);
  // The chamfer dark as well: all light on the strip of the top is lost.
  EXPECT_NEAR(change(-60.0 * kDegree), -std::cos(60.0 * kDegree), 1e-6);
}

// The change of the image, against a sum over points of the edges.
TEST(EdgeLight, IsTheImageOfTheLossesAlongTheEdges) {
  test_support::DipoleCube cube;
  Led led = cube.scene.lights[0].led()->led;
  const SeenObject& seen = *cube.shots[0].seen;
  const double eta = cube.scene.objects[0].eta_int_over_ext;
  const Medium medium{0.5, 0.01, eta};
  const Eigen::MatrixXd image =
      change_by_edges(seen, led, smooth_knots(cube.lit), {{medium, 1.0}, {medium, 2.0}});
  ASSERT_EQ(image.rows(), static_cast<Eigen::Index>(seen.sites.size()));
  EXPECT_LT((image.col(1) - 2.0 * image.col(0)).norm(), 1e-9 * image.norm());
  const Dipole dipole(medium);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(image.rows());
  for (const Crease& edge : creases(seen.object->mesh(), 0.3)) {
    constexpr int kPieces = 100;
    const Eigen::Vector3d step = (edge.to_mm - edge.from_mm) / kPieces;
    for (int i = 0; i < kPieces; ++i) {
      const Eigen::Vector3d p = edge.from_mm + (i + 0.5) * step;
      const double lost = std::min(0.0, light_by_chamfer_per_mm(led, edge, p, eta)) * step.norm();
      for (Eigen::Index j = 0; j < sum.size(); ++j) {
        const double d = (seen.sites[static_cast<std::size_t>(j)].center_mm - p).norm();
        sum[j] += lost * dipole.reflectance_per_mm2(d);
      }
    }
  }
  EXPECT_LT(sum.maxCoeff(), 0.0);
  EXPECT_LT((image.col(0) - sum).norm(), 0.02 * sum.norm());
}

}  // namespace
}  // namespace scattermeter
