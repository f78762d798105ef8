#include "core/light/environment_light.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "core/light/sky_probe.h"
#include "core/material/fresnel.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/probes.h"
#include "tests/fixtures/core/total_power.h"

namespace scattermeter {
namespace {

using test_support::total;

// A convex body sees the whole probe from every facet: surface times the closed form, no ray.
TEST(EnvironmentLight, ConvexBodyInAnEvenProbe) {
  const TriangleMesh mesh = test_support::make_cube();
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 2.0);
  const ProbeTree probe(
      test_support::even_probe(ProbeProjection::kEquirectangular, 64, 32, {1.0F, 0.5F, 0.0F}));
  const auto light = illuminate(patches, scene, probe, 1.4);
  const double expected = 6.0 * 400.0 * test_support::even_irradiance(1.4);
  EXPECT_NEAR(total(light[0]), expected, 1e-4 * expected);
  EXPECT_NEAR(total(light[1]), 0.5 * expected, 1e-4 * expected);
  EXPECT_TRUE(light[2].lit.empty());
  EXPECT_EQ(light[0].shadow_rays, 0U);
  EXPECT_EQ(light[0].lit.size(), static_cast<std::size_t>(patches.size()));
  const Eigen::Array3d open = open_irradiance(probe, {1, 0, 0}, 1.4);
  EXPECT_NEAR(open[0], test_support::even_irradiance(1.4), 3e-4);
}

// An L: a floor and a wall so high and wide that it takes half of the sky from the floor's foot.
TriangleMesh floor_and_wall(double wall_mm, double half_width_mm) {
  const double outline[6][2] = {{0, 0}, {30, 0}, {30, 2}, {2, 2}, {2, wall_mm}, {0, wall_mm}};
  TriangleMesh mesh;
  for (double y : {-half_width_mm, half_width_mm}) {
    for (const auto& p : outline) mesh.vertices_mm.emplace_back(p[0], y, p[1]);
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    mesh.triangles.push_back({i, j, j + 6});
    mesh.triangles.push_back({i, j + 6, i + 6});
  }
  for (const auto& t : {std::array<int, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    mesh.triangles.push_back({t[0], t[2], t[1]});
    mesh.triangles.push_back({t[0] + 6, t[1] + 6, t[2] + 6});
  }
  if (signed_volume_mm3(mesh) < 0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return mesh;
}

// A wall of height h over the floor, endless along y, at distance x: it covers the directions up to
// elevation atan(h / x) to its side. With eta 1 the irradiance of an even sky is
// pi (1 - (1 - x / sqrt(x^2 + h^2)) / 2): half the cosine-weighted sky beyond that plane angle.
TEST(EnvironmentLight, WallTakesItsPartOfTheSky) {
  const double half_width = 400.0;
  const TriangleMesh mesh = floor_and_wall(12.0, half_width);
  ASSERT_EQ(mesh_problem(mesh), "");
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 4.0);
  const ProbeTree probe(
      test_support::even_probe(ProbeProjection::kEquirectangular, 512, 256, {1, 1, 1}));
  const auto light = illuminate(patches, scene, probe, 1.0);
  double worst = 0.0;
  double sum = 0.0;
  int checked = 0;
  for (const LitTriangle& t : light[1].lit) {
    const int k = t.patch_idx;
    const Eigen::Vector3d c = patches.center_mm(k);
    if (patches.normal(k).z() < 0.5 || c.z() > 3.0 || std::abs(c.y()) > 50.0) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const double x = t.corners_mm[i].x() - 2.0;
      // Rays start 1e-5 of the object's size above the floor.
      const double h = 10.0 - 1e-5 * 2.0 * half_width;
      const double expected = std::numbers::pi * 0.5 * (1.0 + x / std::hypot(x, h));
      const double error = (t.irradiance_sr_per_mm2[i] - expected) / std::numbers::pi;
      worst = std::max(worst, std::abs(error));
      sum += error;
      ++checked;
    }
  }
  ASSERT_GT(checked, 300);
  // At the foot of the wall the point lies 0.008 mm before it and above the floor.
  EXPECT_LT(worst, 2e-3);
  EXPECT_LT(std::abs(sum / checked), 1e-4);
}

// Each patch's power as the mean over points of it, a ray for every part of every pixel: the sun's
// shadow crosses the plate.
TEST(EnvironmentLight, SunAndSkyEqualBruteForce) {
  SkyProbe sky;
  sky.width_px = 128;
  sky.sun_direction = {-0.6, 0.2, 0.7};
  sky.sun_radius_rad = 0.012;  // smaller than a pixel of this picture
  const ProbeTree probe(make_sky_probe(sky));
  ASSERT_FALSE(probe.bright().empty());
  const TriangleMesh mesh = floor_and_wall(9.0, 10.0);
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 1.5);
  const auto light = illuminate(patches, scene, probe, 1.45);
  EXPECT_GT(light[1].shadow_edge_patches, 20);
  const Environment& picture = probe.environment();
  double got = 0.0;
  double expected = 0.0;
  double open = 0.0;
  int looked_at = 0;
  for (int k = 0; k < patches.size(); ++k) {
    const Eigen::Vector3d n = patches.normal(k);
    if (n.z() < 0.9 || patches.center_mm(k).z() > 3.0 || k % 5 != 0) continue;
    ++looked_at;
    got += light[1].patch_power_sr[static_cast<std::size_t>(k)];
    const auto t = patches.corners_mm(k);
    constexpr int kRows = 3;
    double sum = 0.0;
    for (int i = 0; i < kRows; ++i) {
      for (int j = 0; j < kRows - i; ++j) {
        for (const double part : {1.0 / 3.0, 2.0 / 3.0}) {
          if (part > 0.5 && i + j + 1 >= kRows) continue;
          const Eigen::Vector3d p =
              t[0] + (i + part) / kRows * (t[1] - t[0]) + (j + part) / kRows * (t[2] - t[0]);
          for (int y = 0; y < picture.height_px / 2; ++y) {
            for (int x = 0; x < picture.width_px; ++x) {
              const double l =
                  picture.radiance[3 * static_cast<std::size_t>(y * picture.width_px + x) + 1];
              const int parts = l > 50.0 ? 8 : 2;
              for (int q = 0; q < parts * parts; ++q) {
                const double x0 = x + (q % parts) / static_cast<double>(parts);
                const double y0 = y + (q / parts) / static_cast<double>(parts);
                const Eigen::Vector3d w = probe.map().direction(x0 + 0.5 / parts, y0 + 0.5 / parts);
                const double c = n.dot(w);
                if (!(c > 0.0)) continue;
                const double e =
                    l * c * fresnel_transmittance(1.45, c) *
                    probe.map().solid_angle_sr({x0, y0, x0 + 1.0 / parts, y0 + 1.0 / parts});
                open += e / (kRows * kRows) * patches.area_mm2(k);
                if (!scene.occluded_toward(p, n, w)) sum += e;
              }
            }
          }
        }
      }
    }
    expected += sum / (kRows * kRows) * patches.area_mm2(k);
  }
  ASSERT_GT(looked_at, 30);
  EXPECT_LT(expected, 0.98 * open);
  // The yardstick's nine points a patch find the sun's shadow edge to 1/9 of a patch each: some ten
  // edge patches of the hundred looked at, 0.3 * 0.11 * sqrt(10) / 100.
  EXPECT_NEAR(got, expected, 1e-3 * open);
}

TEST(EnvironmentLight, ThreadsDoNotChangeTheDigits) {
  SkyProbe sky;
  sky.width_px = 256;
  const ProbeTree probe(make_sky_probe(sky));
  const TriangleMesh mesh = floor_and_wall(9.0, 10.0);
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 1.5);
  std::vector<double> first;
  for (const std::size_t threads : {1U, 3U}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            threads);
    const auto light = illuminate(patches, scene, probe, 1.3);
    if (first.empty()) {
      first = light[2].patch_power_sr;
    } else {
      EXPECT_EQ(first, light[2].patch_power_sr);
    }
  }
}

// A kilometre away from the origin.
TEST(EnvironmentLight, FarFromTheOrigin) {
  SkyProbe sky;
  sky.width_px = 256;
  const ProbeTree probe(make_sky_probe(sky));
  TriangleMesh mesh = floor_and_wall(9.0, 10.0);
  const auto power = [&] {
    const RayScene scene(mesh);
    return total(illuminate(PatchMesh(mesh, 1.5), scene, probe, 1.3)[1]);
  };
  const double here = power();
  for (Eigen::Vector3d& v : mesh.vertices_mm) v += Eigen::Vector3d(6e5, -8e5, 1e5);
  // Vertices keep 1e-10 mm, rays start 1e-7 mm elsewhere: single probes on an edge may change.
  EXPECT_NEAR(power(), here, 1e-5 * here);
}

}  // namespace
}  // namespace scattermeter
