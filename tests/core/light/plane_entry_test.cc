#include "core/light/plane_entry.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/material/fresnel.h"
#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

// Sums of entering power over the facets that the samples fly away from.
std::vector<test_support::BlockMean> power_by_facet(const RayScene& scene,
                                                    const EntrySource& source, int blocks,
                                                    int samples) {
  const auto n = scene.mesh().triangles.size();
  std::vector<test_support::BlockMean> out(n);
  for (int b = 0; b < blocks; ++b) {
    RandomStream random(3, static_cast<std::uint64_t>(b));
    std::vector<double> sum(n, 0.0);
    for (int i = 0; i < samples; ++i) {
      const auto entry = source.sample((i + random.uniform()) / samples, random);
      if (!entry) continue;
      const Eigen::Vector3d outside = entry->position_mm - 1e-3 * entry->direction;
      const RayHit hit = scene.first_hit(outside, entry->direction);
      EXPECT_GE(hit.facet_idx, 0);
      if (hit.facet_idx < 0) continue;
      sum[static_cast<std::size_t>(hit.facet_idx)] += entry->power / samples;
    }
    for (std::size_t f = 0; f < n; ++f) out[f].add(sum[f]);
  }
  return out;
}

// High above an evenly lit plane, a facet sees the plane in the share (1 - cos tilt) / 2 of its
// view: the tilt of each facet of a turned box is another one.
TEST(PlaneEntry, EvenPlaneLightsByTilt) {
  TriangleMesh box = test_support::make_box({-2, -3, -1}, {2, 3, 1});
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()))
                                   .toRotationMatrix();
  for (Eigen::Vector3d& v : box.vertices_mm) v = turn * v;
  const RayScene scene(box);
  Led led;
  led.position_mm = {3e6, 0, 1e7};
  led.exponent = 0;
  led.axis = -led.position_mm.normalized();
  constexpr double kHeight = 500;
  const double e = std::cos(std::atan(0.3)) / led.position_mm.squaredNorm();
  for (const double albedo : {1.0, 0.3}) {
    const auto source = plane_entry(scene, led, {-kHeight, albedo}, 1.0);
    const auto power = power_by_facet(scene, *source, 20, 20000);
    for (std::size_t f = 0; f < power.size(); ++f) {
      const Eigen::Vector3d area = area_vector_mm2(box, static_cast<int>(f));
      const double expected = albedo * e * 0.5 * (area.norm() - area.z());
      EXPECT_NEAR(power[f].mean(), expected,
                  test_support::kSigmas * power[f].std_error() + 1e-4 * e * area.norm())
          << f;
      EXPECT_LT(power[f].std_error(), 0.02 * e * area.norm());
    }
  }
}

// Light followed the other way: from points spread over the plane, lit or in shadow, in all
// directions, to what they hit.
std::vector<test_support::BlockMean> followed(const RayScene& scene, const Led& led, double z_mm,
                                              double eta) {
  constexpr double kHalf = 60.0;
  constexpr int kSamples = 100000;
  const auto n = scene.mesh().triangles.size();
  std::vector<test_support::BlockMean> out(n);
  for (int b = 0; b < 30; ++b) {
    RandomStream random(11, static_cast<std::uint64_t>(b));
    std::vector<double> sum(n, 0.0);
    for (int i = 0; i < kSamples; ++i) {
      const Eigen::Vector3d p(kHalf * (2.0 * random.uniform() - 1.0),
                              kHalf * (2.0 * random.uniform() - 1.0), z_mm);
      const RandomStream::DiscPoint d = random.disc();
      const Eigen::Vector3d w(d.x, d.y, std::sqrt(1.0 - d.r2));
      const RayHit hit = scene.first_hit(p, w);
      if (hit.facet_idx < 0) continue;
      const Eigen::Vector3d normal = area_vector_mm2(scene.mesh(), hit.facet_idx).normalized();
      const Eigen::Vector3d to_led = led.position_mm - p;
      const RayHit before_led = scene.first_hit(p, to_led);
      if (before_led.facet_idx >= 0 && before_led.distance < 1.0) continue;
      const double r2 = to_led.squaredNorm();
      const double e = led.lobe(-to_led.normalized()) * to_led.z() / (r2 * std::sqrt(r2));
      sum[static_cast<std::size_t>(hit.facet_idx)] +=
          4.0 * kHalf * kHalf * e * fresnel_transmittance(eta, -normal.dot(w)) / kSamples;
    }
    for (std::size_t f = 0; f < n; ++f) out[f].add(sum[f]);
  }
  return out;
}

void expect_followed(const TriangleMesh& mesh, const Led& led, double z_mm, double eta) {
  const RayScene scene(mesh);
  const auto source = plane_entry(scene, led, {z_mm, 1.0}, eta);
  const auto power = power_by_facet(scene, *source, 30, 10000);
  const auto expected = followed(scene, led, z_mm, eta);
  double all = 0.0;
  double all_expected = 0.0;
  for (std::size_t f = 0; f < power.size(); ++f) {
    const double error = std::hypot(power[f].std_error(), expected[f].std_error());
    EXPECT_LE(std::abs(power[f].mean() - expected[f].mean()), test_support::kSigmas * error) << f;
    all += power[f].mean();
    all_expected += expected[f].mean();
  }
  EXPECT_GT(all, 0.0);
  EXPECT_NEAR(all, all_expected, 0.02 * all);
}

// A narrow lobe beside the body lights a spot and casts a shadow; near, on and above the plane, and
// a body that shadows its own view of the plane.
TEST(PlaneEntry, MeetsLightFollowedFromThePlane) {
  Led led;
  led.position_mm = {25, -20, 30};
  led.axis = Eigen::Vector3d(-0.5, 0.4, -0.9).normalized();
  led.exponent = 20;
  expect_followed(test_support::make_box({-5, -5, 0}, {5, 5, 8}), led, 0.0, 1.4);
  expect_followed(test_support::make_box({-5, -5, 0}, {5, 5, 8}), led, -3.0, 1.4);
  TriangleMesh two = test_support::make_box({-5, -5, 0}, {5, 5, 8});
  const TriangleMesh other = test_support::make_box({7, -5, 0}, {9, 5, 7});
  for (const auto& t : other.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  two.vertices_mm.insert(two.vertices_mm.end(), other.vertices_mm.begin(), other.vertices_mm.end());
  expect_followed(two, led, -1.0, 1.3);
}

// The sum of both sources has both powers; without albedo, or with the LED below the plane, it is
// the LED's own source in every digit.
TEST(PlaneEntry, AddsToTheLed) {
  const RayScene scene(test_support::make_box({-5, -5, 0}, {5, 5, 8}));
  Led led;
  led.position_mm = {25, -20, 30};
  led.axis = -led.position_mm.normalized();
  const auto mean = [](const EntrySource& source) {
    test_support::BlockMean power;
    for (int b = 0; b < 30; ++b) {
      RandomStream random(5, static_cast<std::uint64_t>(b));
      double sum = 0.0;
      for (int i = 0; i < 4000; ++i) {
        const auto entry = source.sample((i + random.uniform()) / 4000, random);
        if (entry) sum += entry->power / 4000;
      }
      power.add(sum);
    }
    return power;
  };
  const auto direct = mean(*led_entry(scene, led, 1.4));
  const auto by_plane = mean(*plane_entry(scene, led, {0.0, 0.7}, 1.4));
  const auto both = mean(*led_entry_above(scene, led, {0.0, 0.7}, 1.4));
  const double expected = direct.mean() + by_plane.mean();
  EXPECT_GT(by_plane.mean(), 0.1 * direct.mean());
  EXPECT_NEAR(both.mean(), expected,
              test_support::kSigmas * std::hypot(both.std_error(), by_plane.std_error()));
  EXPECT_LT(both.std_error(), 0.003 * expected);
  for (const DiffusePlane& plane : {DiffusePlane{0.0, 0.0}, DiffusePlane{31.0, 0.5}}) {
    RandomStream one(1, 0);
    RandomStream other(1, 0);
    const auto a = led_entry(scene, led, 1.4)->sample(0.3, one);
    const auto b = led_entry_above(scene, led, plane, 1.4)->sample(0.3, other);
    ASSERT_TRUE(a && b);
    EXPECT_EQ(a->power, b->power);
    EXPECT_EQ(a->position_mm, b->position_mm);
  }
}

}  // namespace
}  // namespace scattermeter
