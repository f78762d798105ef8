#include "core/diffusion/shade_map.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/pinhole_rays.h"

namespace scattermeter {
namespace {

// Covered pixels add up to the silhouette's area, finer than whole pixels would.
TEST(ShadeMap, CoverageIsTheSilhouettesArea) {
  // Straight from above the top face (z 20) of the cube: a square of 20 mm at 180 mm.
  const TriangleMesh mesh = test_support::make_cube();
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 2.0);
  // A little off the axis, so that only the top is seen but edges do not fall on pixel borders.
  const RayGrid rays = test_support::pinhole_rays({0.01, 0.02, 200}, {0, 0, 0}, 653.7, 120, 120);
  const ShadeMap map(rays, scene, patches, 1.3);
  double area_px = 0.0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 120; ++x) area_px += map.coverage(x, y);
  }
  const double side_px = 20.0 / 180.0 * 653.7;
  EXPECT_NEAR(area_px, side_px * side_px, 0.003 * side_px * side_px);
}

// A field of 1 W/mm^2 everywhere: radiance Ft / pi inside, in proportion to the coverage at the
// rim.
TEST(ShadeMap, RadianceOfAnEvenField) {
  const TriangleMesh mesh = test_support::make_cube();
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 2.0);
  const RayGrid rays = test_support::pinhole_rays({40, -90, 120}, {0, 0, 10}, 400.0, 110, 110);
  const ShadeMap map(rays, scene, patches, 1.4);
  SurfaceField field(patches, map.needed_patches(patches.size()));
  field.add(std::vector<Eigen::Array3d>(field.nodes_mm().size(), Eigen::Array3d::Ones()));
  int whole = 0, inside = 0, mixed = 0;
  for (int y = 0; y < 110; ++y) {
    for (int x = 0; x < 110; ++x) {
      const double c = map.coverage(x, y);
      const double l = map.radiance(x, y, field, 1);
      if (c == 0.0) {
        EXPECT_EQ(l, 0.0);
      }
      const Eigen::Vector3d d = rays.directions_in_world[static_cast<std::size_t>(y * 110 + x)]
                                    .cast<double>()
                                    .normalized();
      const RayHit hit = scene.first_hit(rays.origin_in_world_mm, d);
      if (c == 1.0) {
        ++whole;
        // Inside a face the centre stands for the pixel; across an edge between two faces the mean
        // of both, whose transmittances differ by less than 0.35 in this view.
        const double ft = fresnel_transmittance(1.4, -patches.facet_normal(hit.facet_idx).dot(d));
        inside += std::abs(l - ft / std::numbers::pi) < 1e-6 ? 1 : 0;
        EXPECT_NEAR(l, ft / std::numbers::pi, 0.35 / std::numbers::pi);
      } else if (c > 0.0) {
        ++mixed;
        EXPECT_LE(l, c * fresnel_transmittance(1.4, 1.0) / std::numbers::pi + 1e-6);
        EXPECT_GE(l, c * 0.65 / std::numbers::pi);
      }
    }
  }
  EXPECT_GT(inside, 0.9 * whole);
  EXPECT_GT(whole, 1000);
  EXPECT_GT(mixed, 100);
}

}  // namespace
}  // namespace scattermeter
