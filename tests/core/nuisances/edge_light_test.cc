#include "core/nuisances/edge_light.h"

#include <gtest/gtest.h>

#include "core/material/dipole.h"
#include "core/mesh/creases.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

// The edge between a top face and a side that faces x, of a body below and left of it.
TEST(EdgeLight, ChamferOfAConvexEdge) {
  const Crease edge{{0, 0, 0}, {0, 1, 0}, {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()}};
  const ChamferedEdge c = chamfered(edge, 0.2);
  EXPECT_TRUE(c.is_convex);
  EXPECT_LT((c.inward_mm[0] - Eigen::Vector3d(0, 0, -0.2)).norm(), 1e-12);
  EXPECT_LT((c.inward_mm[1] - Eigen::Vector3d(-0.2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((c.normal - Eigen::Vector3d(1, 0, 1).normalized()).norm(), 1e-12);
  const Crease hollow{{0, 0, 0}, {0, 1, 0}, {-Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()}};
  EXPECT_FALSE(chamfered(hollow, 0.2).is_convex);
}

// The change of the image, against a sum over points of strips and chamfers.
TEST(EdgeLight, IsTheImageOfTheChangesAlongTheEdges) {
  test_support::DipoleCube cube;
  Led led = cube.scene.lights[0].led()->led;
  const SeenObject& seen = *cube.shots[0].seen;
  const double eta = cube.scene.objects[0].eta_int_over_ext;
  const Medium medium{0.5, 0.01, eta};
  const double width_mm = chamfer_width_mm(*seen.object->stated);
  const Eigen::MatrixXd image = change_by_edges(
      seen, led, smooth_knots(cube.lit), {{medium, 1.0}, {medium, 2.0}}, {width_mm, width_mm});
  ASSERT_EQ(image.rows(), static_cast<Eigen::Index>(seen.sites.size()));
  EXPECT_LT((image.col(1) - 2.0 * image.col(0)).norm(), 1e-9 * image.norm());
  const Dipole dipole(medium);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(image.rows());
  for (const Crease& edge : creases(seen.object->mesh(), 0.3)) {
    constexpr int kPieces = 100, kAcross = 6;
    const Eigen::Vector3d step = (edge.to_mm - edge.from_mm) / kPieces;
    const ChamferedEdge c = chamfered(edge, width_mm);
    ASSERT_TRUE(c.is_convex);
    const Eigen::Vector3d side = c.inward_mm[1] - c.inward_mm[0];
    for (int i = 0; i < kPieces; ++i) {
      const Eigen::Vector3d p = edge.from_mm + (i + 0.5) * step;
      const auto add = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& across,
                           const Eigen::Vector3d& normal, double sign) {
        const double power = sign * led.transmitted_irradiance_per_mm2(p, normal, eta) *
                             step.norm() * across.norm() / kAcross / width_mm;
        for (int k = 0; k < kAcross; ++k) {
          const Eigen::Vector3d at = from + (k + 0.5) / kAcross * across;
          for (Eigen::Index j = 0; j < sum.size(); ++j) {
            const ExitSite& site = seen.sites[static_cast<std::size_t>(j)];
            for (int p_idx = 0; p_idx < site.n_points; ++p_idx) {
              const auto q = static_cast<std::size_t>(p_idx);
              sum[j] += power * site.weights[q] *
                        dipole.reflectance_per_mm2((site.points_mm[q] - at).norm());
            }
          }
        }
      };
      add(p, c.inward_mm[0], edge.normals[0], -1.0);
      add(p, c.inward_mm[1], edge.normals[1], -1.0);
      add(p + c.inward_mm[0], side, c.normal, 1.0);
    }
  }
  EXPECT_LT((image.col(0) - sum).norm(), 0.02 * sum.norm());
}

}  // namespace
}  // namespace scattermeter
