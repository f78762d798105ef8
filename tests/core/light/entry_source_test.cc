#include "core/light/entry_source.h"

#include <gtest/gtest.h>

#include "core/light/environment_light.h"
#include "core/light/incident_light.h"
#include "core/light/sky_probe.h"
#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/total_power.h"

namespace scattermeter {
namespace {

// Two boxes, the smaller one in the larger one's light.
TriangleMesh two_boxes() {
  TriangleMesh mesh = test_support::make_box({-10, -10, 0}, {10, 10, 8});
  const TriangleMesh other = test_support::make_box({4, -8, 9}, {9, -3, 15});
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  mesh.vertices_mm.insert(mesh.vertices_mm.end(), other.vertices_mm.begin(),
                          other.vertices_mm.end());
  return mesh;
}

// The mean power is that of IncidentLight, whole and by facet; directions point inwards, refracted.
void expect_power(const RayScene& scene, const EntrySource& source, const PatchMesh& patches,
                  const IncidentLight& light, int blocks) {
  std::vector<double> expected(scene.mesh().triangles.size(), 0.0);
  for (int k = 0; k < patches.size(); ++k) {
    expected[static_cast<std::size_t>(patches.facet_idx(k))] +=
        light.patch_power_sr[static_cast<std::size_t>(k)];
  }
  std::vector<Eigen::Vector3d> normal;
  for (std::size_t f = 0; f < expected.size(); ++f) {
    normal.push_back(area_vector_mm2(scene.mesh(), static_cast<int>(f)).normalized());
  }
  test_support::BlockMean total;
  std::vector<test_support::BlockMean> by_facet(expected.size());
  constexpr int kSamples = 500;
  for (int b = 0; b < blocks; ++b) {
    RandomStream random(5, static_cast<std::uint64_t>(b));
    std::vector<double> sum(expected.size(), 0.0);
    double all = 0.0;
    for (int i = 0; i < kSamples; ++i) {
      const auto entry = source.sample((i + random.uniform()) / kSamples, random);
      if (!entry) continue;
      // The facet is the one the sample starts on and flies away from.
      std::size_t on = expected.size();
      for (std::size_t f = 0; f < expected.size(); ++f) {
        const Eigen::Vector3d& n = normal[f];
        const auto& t = scene.mesh().triangles[f];
        const Eigen::Vector3d& a = scene.mesh().vertices_mm[static_cast<std::size_t>(t[0])];
        const Eigen::Vector3d& b0 = scene.mesh().vertices_mm[static_cast<std::size_t>(t[1])];
        const Eigen::Vector3d& c = scene.mesh().vertices_mm[static_cast<std::size_t>(t[2])];
        const Eigen::Vector3d& x = entry->position_mm;
        if (std::abs(n.dot(x - a)) > 1e-9 || n.dot(entry->direction) > 0.0) continue;
        if (n.dot((b0 - a).cross(x - a)) < 0.0 || n.dot((c - b0).cross(x - b0)) < 0.0 ||
            n.dot((a - c).cross(x - c)) < 0.0) {
          continue;
        }
        on = f;
        // Behind the boundary no direction is flatter than the critical angle.
        EXPECT_GT(-n.dot(entry->direction), std::sqrt(1.0 - 1.0 / (1.3 * 1.3)) - 1e-9);
      }
      ASSERT_LT(on, expected.size());
      ASSERT_NEAR(entry->direction.norm(), 1.0, 1e-12);
      sum[on] += entry->power / kSamples;
      all += entry->power / kSamples;
    }
    total.add(all);
    for (std::size_t f = 0; f < sum.size(); ++f) by_facet[f].add(sum[f]);
  }
  EXPECT_LT(std::abs(total.z(test_support::total(light))), test_support::kSigmas);
  EXPECT_LT(total.std_error(), 0.01 * total.mean());
  for (std::size_t f = 0; f < expected.size(); ++f) {
    if (expected[f] == 0.0) {
      EXPECT_EQ(by_facet[f].mean(), 0.0);
    } else if (expected[f] > 1e-3 * test_support::total(light)) {
      EXPECT_LT(std::abs(by_facet[f].z(expected[f])), test_support::kSigmas) << "facet " << f;
    }
  }
}

TEST(EntrySource, LedGivesWhatIncidentLightSays) {
  const RayScene scene(two_boxes());
  const PatchMesh patches(scene.mesh(), 1.0);
  for (double radius_mm : {0.0, 6.0}) {
    Led led;
    led.position_mm = {25, -40, 50};
    led.axis = -led.position_mm.normalized();
    led.exponent = 2;
    led.radius_mm = radius_mm;
    expect_power(scene, *led_entry(scene, led, 1.3), patches, illuminate(patches, scene, led, 1.3),
                 60);
  }
}

TEST(EntrySource, EnvironmentGivesWhatEnvironmentLightSays) {
  const RayScene scene(two_boxes());
  const PatchMesh patches(scene.mesh(), 1.0);
  const ProbeTree probe(make_sky_probe());
  const auto light = illuminate(patches, scene, probe, 1.3);
  for (int channel : {0, 2}) {
    expect_power(scene, *environment_entry(scene, probe.environment(), channel, 1.3), patches,
                 light[static_cast<std::size_t>(channel)], 200);
  }
}

TEST(EntrySource, BeamIsEven) {
  const auto source = beam_entry({{1, 2, 3}, {4, 0, 0}, {0, 2, 0}, {0, 0, -1}});
  RandomStream random(6, 0);
  test_support::BlockMean x, y;
  for (int i = 0; i < 1000; ++i) {
    const auto entry = source->sample(random.uniform(), random);
    ASSERT_TRUE(entry.has_value());
    EXPECT_EQ(entry->power, 1.0);
    EXPECT_EQ(entry->position_mm.z(), 3.0);
    x.add(entry->position_mm.x());
    y.add(entry->position_mm.y());
  }
  EXPECT_LT(std::abs(x.z(3.0)), test_support::kSigmas);
  EXPECT_LT(std::abs(y.z(3.0)), test_support::kSigmas);
}

}  // namespace
}  // namespace scattermeter
