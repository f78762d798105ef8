#include "core/light/incident_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"
#include "core/mesh/round_bodies.h"
#include "core/mesh/triangle_parts.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/total_power.h"

namespace scattermeter {
namespace {

using test_support::total;

// Without a boundary (eta 1) the power that enters a convex body is the intensity times the solid
// angle it fills. A square of half-width a at distance h on the axis fills 4 asin(a^2 / (a^2 +
// h^2)).
TEST(IncidentLight, PowerIsIntensityTimesSolidAngle) {
  Led led;
  led.position_mm = {0, 0, 60};
  led.axis = {0, 0, -1};
  led.exponent = 0;
  const TriangleMesh plate = test_support::make_box({-10, -10, -1}, {10, 10, 0});
  const RayScene scene(plate);
  const IncidentLight light = illuminate(PatchMesh(plate, 0.5), scene, led, 1.0);
  const double solid_angle = 4.0 * std::asin(100.0 / (100.0 + 3600.0));
  EXPECT_NEAR(total(light), solid_angle, 1e-4 * solid_angle);
  EXPECT_EQ(light.shadow_edge_patches, 0);
}

// A convex body throws no shadow on itself: no rays, and the light that rays would give.
TEST(IncidentLight, CastsNoRaysOnAConvexBody) {
  const TriangleMesh cube = test_support::make_cube();
  // With a crumb far behind, the scene is two bodies and not convex.
  TriangleMesh with_crumb = cube;
  const TriangleMesh crumb = test_support::make_box({0, 0, -100}, {0.1, 0.1, -99.9});
  const auto first = static_cast<int>(cube.vertices_mm.size());
  for (const Eigen::Vector3d& v : crumb.vertices_mm) with_crumb.vertices_mm.push_back(v);
  for (const auto& t : crumb.triangles) {
    with_crumb.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  const RayScene skipping(cube), casting(with_crumb);
  EXPECT_TRUE(skipping.convex());
  EXPECT_FALSE(casting.convex());
  const PatchMesh patches(cube, 0.6);
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = Eigen::Vector3d(-30, 60, -70).normalized();
  led.exponent = 1.5;
  const IncidentLight a = illuminate(patches, skipping, led, 1.4);
  const IncidentLight b = illuminate(patches, casting, led, 1.4);
  EXPECT_EQ(a.shadow_rays, 0U);
  EXPECT_EQ(a.shadow_rays_skipped, b.shadow_rays);
  EXPECT_EQ(b.shadow_rays_skipped, 0U);
  EXPECT_EQ(a.patch_power_sr, b.patch_power_sr);
  // A convex body beside the patches' own is no reason to skip: it may stand in the light.
  const RayScene other(test_support::make_box({5, -40, 15}, {25, -20, 60}));
  EXPECT_TRUE(other.convex());
  const IncidentLight shaded = illuminate(patches, other, led, 1.4);
  EXPECT_EQ(shaded.shadow_rays_skipped, 0U);
  EXPECT_LT(total(shaded), 0.9 * total(a));
}

// The facets of a sphere are lit as the sphere is: a facet's own normal is half a degree and more
// off over most of it, which near the terminator, where the transmittance falls off, changes the
// mean as well.
TEST(IncidentLight, FacetsOfASphereAreLitAsTheSphere) {
  const Eigen::Vector3d center_mm(0, 0, 10);
  const TriangleMesh sphere = sphere_mesh(4);
  const RayScene scene(sphere);
  const PatchMesh patches(sphere, 2.0);  // whole facets
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = Eigen::Vector3d(-30, 60, -70).normalized();
  led.exponent = 1.5;
  const IncidentLight light = illuminate(patches, scene, led, 1.49);
  double brightest = 0.0, worst = 0.0, worst_by_facets = 0.0;
  for (int k = 0; k < patches.size(); ++k) {
    double of_sphere = 0.0, of_facet = 0.0;
    for_16_parts(patches.corners_mm(k), [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d radial = (p - center_mm).normalized();
      of_sphere += led.transmitted_irradiance_per_mm2(p, radial, 1.49) / 16;
      of_facet += led.transmitted_irradiance_per_mm2(p, patches.normal(k), 1.49) / 16;
    });
    const double found = light.patch_power_sr[static_cast<std::size_t>(k)] / patches.area_mm2(k);
    brightest = std::max(brightest, of_sphere);
    worst = std::max(worst, std::abs(found - of_sphere));
    worst_by_facets = std::max(worst_by_facets, std::abs(of_facet - of_sphere));
  }
  EXPECT_LT(worst, 4e-4 * brightest);
  EXPECT_GT(worst_by_facets, 4e-3 * brightest);
}

// Two patch sizes agree, with Fresnel and lobe.
TEST(IncidentLight, DoesNotDependOnThePatchSize) {
  Led led;
  led.position_mm = {30, -60, 80};
  led.axis = Eigen::Vector3d(-30, 60, -70).normalized();
  led.exponent = 1.5;
  const TriangleMesh mesh = test_support::make_cube();
  const RayScene scene(mesh);
  const double coarse = total(illuminate(PatchMesh(mesh, 0.8), scene, led, 1.4));
  const double fine = total(illuminate(PatchMesh(mesh, 0.2), scene, led, 1.4));
  EXPECT_NEAR(coarse, fine, 2e-5 * fine);
}

// An L of floor and wall: the wall (2 mm thick, 10 mm high) throws a shadow of known length on the
// floor.
TriangleMesh floor_with_wall() {
  // Outline in (x, z), swept along y: floor 0..30 x 0..2, wall 0..2 x 2..12.
  const double outline[6][2] = {{0, 0}, {30, 0}, {30, 2}, {2, 2}, {2, 12}, {0, 12}};
  TriangleMesh mesh;
  for (double y : {0.0, 20.0}) {
    for (const auto& p : outline) mesh.vertices_mm.emplace_back(p[0], y, p[1]);
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  // The ends: the outline from (0, 0) as a fan of its two rectangles.
  for (const auto& t : {std::array<int, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TEST(IncidentLight, ShadowEdgeCutsPatchesAtTheRightPlace) {
  TriangleMesh mesh = floor_with_wall();
  if (signed_volume_mm3(mesh) < 0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  ASSERT_EQ(mesh_problem(mesh), "");
  const RayScene scene(mesh);
  // Far away, 45 degrees in the x-z plane: the shadow of the wall's edge (x 2, z 12) ends at x
  // = 12.
  Led led;
  led.position_mm = {2 - 1e6, 10, 12 + 1e6};
  led.axis = Eigen::Vector3d(1, 0, -1).normalized();
  led.exponent = 0;
  const PatchMesh patches(mesh, 0.7);
  const IncidentLight light = illuminate(patches, scene, led, 1.0);
  EXPECT_GT(light.shadow_edge_patches, 20);
  double lit_floor_mm2 = 0.0;
  for (int k = 0; k < patches.size(); ++k) {
    const bool floor = patches.normal(k).z() > 0.5 && patches.center_mm(k).z() < 3.0;
    if (!floor) continue;
    const double e = std::cos(std::numbers::pi / 4) / (2e12);
    lit_floor_mm2 += light.patch_power_sr[static_cast<std::size_t>(k)] / e;
  }
  // 18 mm of the floor's 28 are lit, over 20 mm; the edge is found to a few hundredths of a patch's
  // part.
  EXPECT_NEAR(lit_floor_mm2, 18.0 * 20.0, 0.0005 * 360.0);
}

TEST(IncidentLight, NothingOnTheFarSide) {
  Led led;
  led.position_mm = {0, 0, 100};
  const TriangleMesh mesh = test_support::make_cube();
  const PatchMesh patches(mesh, 1.0);
  const IncidentLight light = illuminate(patches, RayScene(mesh), led, 1.3);
  for (int k = 0; k < patches.size(); ++k) {
    const bool top = patches.normal(k).z() > 0.5;
    EXPECT_EQ(light.patch_power_sr[static_cast<std::size_t>(k)] > 0.0, top);
  }
  led.axis = {0, 0, 1};  // shines away
  EXPECT_TRUE(illuminate(patches, RayScene(mesh), led, 1.3).lit.empty());
}

}  // namespace
}  // namespace scattermeter
