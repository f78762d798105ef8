#include "core/light/disc_light.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/light/incident_light.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

Led disc_led(double radius_mm) {
  Led led;
  led.position_mm = {3, -8, 40};
  led.axis = Eigen::Vector3d(0.1, 0.3, -1.0).normalized();
  led.exponent = 1.5;
  led.radius_mm = radius_mm;
  return led;
}

// Mean over the disc on a grid of rings and angles, rays and all; no cleverness.
double brute_force(const Led& led, const RayScene& scene, const Eigen::Vector3d& p,
                   const Eigen::Vector3d& n, double eta) {
  const Eigen::Vector3d a = led.axis.unitOrthogonal();
  const Eigen::Vector3d b = led.axis.cross(a);
  constexpr int kRings = 300;
  constexpr int kAngles = 601;
  double sum = 0.0;
  for (int i = 0; i < kRings; ++i) {
    const double r = led.radius_mm * std::sqrt((i + 0.5) / kRings);
    for (int j = 0; j < kAngles; ++j) {
      const double phi = 2.0 * std::numbers::pi * (j + 0.5) / kAngles;
      Led part = led;
      part.position_mm += r * (std::cos(phi) * a + std::sin(phi) * b);
      const double e = part.transmitted_irradiance_per_mm2(p, n, eta);
      if (e > 0.0 && !scene.occluded(p, n, part.position_mm)) sum += e;
    }
  }
  return sum / (kRings * kAngles);
}

TEST(DiscLight, OpenEqualsBruteForce) {
  const TriangleMesh mesh = test_support::make_box({-10, -10, -1}, {10, 10, 0});
  const RayScene scene(mesh);
  for (const double radius_mm : {1.0, 8.0, 19.0}) {
    const DiscLight disc(disc_led(radius_mm), scene, 1.4);
    for (const Eigen::Vector3d& p : {Eigen::Vector3d(0, 0, 0), {7, 8, 0}, {-9, 2, 0}}) {
      const Eigen::Vector3d n(0, 0, 1);
      const double expected = brute_force(disc_led(radius_mm), scene, p, n, 1.4);
      EXPECT_NEAR(disc.open_per_mm2(p, n), expected, 1e-5 * expected) << radius_mm;
    }
  }
}

// The surface's plane cuts the disc.
TEST(DiscLight, HalfOfTheDiscBelowTheHorizon) {
  const TriangleMesh mesh = test_support::make_box({-10, -10, -1}, {10, 10, 0});
  const RayScene scene(mesh);
  Led led = disc_led(6.0);
  led.position_mm = {-40, 0, 1.5};
  led.axis = {1, 0, 0};
  const DiscLight disc(led, scene, 1.3);
  const double expected = brute_force(led, scene, {0, 0, 0}, {0, 0, 1}, 1.3);
  EXPECT_NEAR(disc.open_per_mm2({0, 0, 0}, {0, 0, 1}), expected, 1e-3 * expected);
}

TEST(DiscLight, ConcentricMapKeepsAreasAndFillsTheDisc) {
  const TriangleMesh mesh = test_support::make_cube();
  const RayScene scene(mesh);
  Led led = disc_led(2.0);
  const DiscLight disc(led, scene, 1.0);
  constexpr int kSide = 200;
  double inside = 0.0;
  double r2 = 0.0;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const Eigen::Vector3d d =
          disc.disc_point_mm((i + 0.5) / kSide, (j + 0.5) / kSide) - led.position_mm;
      EXPECT_LE(d.norm(), 2.0);
      EXPECT_NEAR(d.dot(led.axis), 0.0, 1e-12);
      inside += d.norm() < 1.0 ? 1.0 : 0.0;
      r2 += d.squaredNorm();
    }
  }
  EXPECT_NEAR(inside / (kSide * kSide), 0.25,
              0.005);                            // a quarter of the area within half the radius
  EXPECT_NEAR(r2 / (kSide * kSide), 2.0, 1e-3);  // mean of r^2 over a disc: R^2 / 2
}

// A plate with a block on it that stands between the plate and the LED.
TriangleMesh plate_and_block() {
  TriangleMesh mesh = test_support::make_box({-20, -20, -1}, {20, 20, 0});
  const TriangleMesh block = test_support::make_box({-4, -20, 10}, {0, 20, 14});
  for (auto t : block.triangles) {
    for (int& i : t) i += static_cast<int>(mesh.vertices_mm.size());
    mesh.triangles.push_back(t);
  }
  mesh.vertices_mm.insert(mesh.vertices_mm.end(), block.vertices_mm.begin(),
                          block.vertices_mm.end());
  return mesh;
}

TEST(DiscLight, HalfShadowEqualsBruteForce) {
  const TriangleMesh mesh = plate_and_block();
  const RayScene scene(mesh);
  Led led = disc_led(5.0);
  const DiscLight disc(led, scene, 1.4);
  const Eigen::Vector3d n(0, 0, 1);
  int half = 0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector3d p(-12.0 + 0.5 * i, 1.3, 0);
    std::size_t rays = 0;
    const double share = disc.visible_share(p, n, rays);
    const double open = disc.open_per_mm2(p, n);
    EXPECT_NEAR(share * open, brute_force(led, scene, p, n, 1.4), 0.005 * open) << p.x();
    EXPECT_GT(rays, 0U);
    half += share > 0.02 && share < 0.98 ? 1 : 0;
  }
  EXPECT_GT(half, 4);
}

// A small disc is a point, inside and outside of shadows.
TEST(DiscLight, SmallRadiusIsThePoint) {
  const TriangleMesh mesh = plate_and_block();
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 1.0);
  const IncidentLight point = illuminate(patches, scene, disc_led(0.0), 1.4);
  const IncidentLight disc = illuminate(patches, scene, disc_led(1e-3), 1.4);
  ASSERT_GT(point.shadow_edge_patches, 20);
  double sum = 0.0;
  double difference = 0.0;
  for (std::size_t k = 0; k < point.patch_power_sr.size(); ++k) {
    sum += point.patch_power_sr[k];
    difference += point.patch_power_sr[k] - disc.patch_power_sr[k];
    // The edge within a patch: to a share of one of its 64 parts.
    EXPECT_NEAR(disc.patch_power_sr[k], point.patch_power_sr[k], 0.02 * 6e-4);
  }
  EXPECT_LT(std::abs(difference), 1e-4 * sum);
}

// Through illuminate(), across the half shadow: the whole plate's power against brute force on a
// fine grid of points.
TEST(DiscLight, PatchPowersHoldTheHalfShadow) {
  const TriangleMesh mesh = plate_and_block();
  const RayScene scene(mesh);
  const PatchMesh patches(mesh, 0.75);
  const Led led = disc_led(5.0);
  const IncidentLight light = illuminate(patches, scene, led, 1.4);
  EXPECT_GT(light.shadow_edge_patches, 50);
  double expected = 0.0;
  double got = 0.0;
  const DiscLight disc(led, scene, 1.4);
  for (int k = 0; k < patches.size(); ++k) {
    const Eigen::Vector3d c = patches.center_mm(k);
    if (patches.normal(k).z() < 0.5 || c.z() > 1.0) continue;
    got += light.patch_power_sr[static_cast<std::size_t>(k)];
    const auto t = patches.corners_mm(k);
    constexpr int kRows = 4;  // centres of 16 equal parts
    double sum = 0.0;
    for (int i = 0; i < kRows; ++i) {
      for (int j = 0; j < kRows - i; ++j) {
        for (const double part : {1.0 / 3.0, 2.0 / 3.0}) {
          if (part > 0.5 && i + j + 1 >= kRows) continue;
          const Eigen::Vector3d p =
              t[0] + (i + part) / kRows * (t[1] - t[0]) + (j + part) / kRows * (t[2] - t[0]);
          std::size_t rays = 0;
          sum += disc.open_per_mm2(p, {0, 0, 1}) * disc.visible_share(p, {0, 0, 1}, rays);
        }
      }
    }
    expected += sum / (kRows * kRows) * patches.area_mm2(k);
  }
  EXPECT_NEAR(got, expected, 5e-4 * expected);
}

TEST(DiscLight, RefusesAPoint) {
  const TriangleMesh mesh = test_support::make_cube();
  const RayScene scene(mesh);
  EXPECT_THROW(DiscLight(disc_led(0.0), scene, 1.3), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
