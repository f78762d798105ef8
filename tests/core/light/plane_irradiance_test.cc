#include "core/light/plane_irradiance.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/light/plane_entry.h"
#include "core/material/fresnel.h"
#include "tests/fixtures/core/block_mean.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/total_power.h"

namespace scattermeter {
namespace {

// An even plane fills (1 - cos tilt) / 2 of the view of a face, wherever that is.
TEST(PlaneIrradiance, EvenPlaneLightsByTilt) {
  TriangleMesh box = test_support::make_box({-2, -3, -1}, {2, 3, 1});
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()))
                                   .toRotationMatrix();
  for (Eigen::Vector3d& v : box.vertices_mm) v = turn * v;
  const RayScene scene(box);
  const PatchMesh patches(box, 1.0);
  const IncidentLight light =
      light_from_plane(patches, scene, -10.0, 1.0, [](const Eigen::Vector3d& at) {
        EXPECT_EQ(at.z(), -10.0);
        return 3.0;
      });
  for (int k = 0; k < patches.size(); ++k) {
    EXPECT_NEAR(light.patch_power_sr[static_cast<std::size_t>(k)],
                3.0 * 0.5 * (1.0 - patches.normal(k).z()) * patches.area_mm2(k),
                0.01 * patches.area_mm2(k));
  }
}

// Horizontal faces that see all of an even plane: the diffuse transmittance, by quadrature.
TEST(PlaneIrradiance, FaceDownGetsTheDiffuseTransmittance) {
  const TriangleMesh box = test_support::make_box({-2, -2, 1}, {2, 2, 3});
  const RayScene scene(box);
  const PatchMesh patches(box, 1.0);
  double transmittance = 0.0;
  for (int i = 0; i < 10000; ++i) {
    transmittance += fresnel_transmittance(1.5, std::sqrt((i + 0.5) / 10000)) / 10000;
  }
  const IncidentLight light =
      light_from_plane(patches, scene, 0.0, 1.5, [](const Eigen::Vector3d&) { return 1.0; });
  double down = 0.0;
  for (int k = 0; k < patches.size(); ++k) {
    if (patches.normal(k).z() < -0.5) down += light.patch_power_sr[static_cast<std::size_t>(k)];
    if (patches.normal(k).z() > 0.5) {
      EXPECT_EQ(light.patch_power_sr[static_cast<std::size_t>(k)], 0.0);
    }
  }
  EXPECT_NEAR(down, 16.0 * transmittance, 2e-3 * down);
  // On the plane itself there is no view of it.
  const IncidentLight touching =
      light_from_plane(patches, scene, 1.0, 1.5, [](const Eigen::Vector3d&) { return 1.0; });
  for (int k = 0; k < patches.size(); ++k) {
    if (patches.normal(k).z() < -0.5) {
      EXPECT_EQ(touching.patch_power_sr[static_cast<std::size_t>(k)], 0.0);
    }
  }
}

// With the shadow of the body and an uneven light: against drawn paths, face by face.
TEST(PlaneIrradiance, MeetsDrawnLight) {
  TriangleMesh two = test_support::make_box({-5, -5, 0}, {5, 5, 8});
  const TriangleMesh other = test_support::make_box({7, -5, 0}, {9, 5, 7});
  for (const auto& t : other.triangles) two.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  two.vertices_mm.insert(two.vertices_mm.end(), other.vertices_mm.begin(), other.vertices_mm.end());
  Led led;
  led.position_mm = {25, -20, 30};
  led.axis = Eigen::Vector3d(-0.6, 0.5, -0.7).normalized();
  for (const TriangleMesh& mesh : {test_support::make_box({-5, -5, 0}, {5, 5, 8}), two}) {
    for (const double z_mm : {0.0, -3.0}) {
      const RayScene scene(mesh);
      const PatchMesh patches(mesh, 1.0);
      const IncidentLight light = light_from_plane(
          patches, scene, z_mm, 1.4,
          [&](const Eigen::Vector3d& at) { return plane_irradiance_per_mm2(scene, led, at); });
      std::vector<double> by_facet(mesh.triangles.size(), 0.0);
      for (int k = 0; k < patches.size(); ++k) {
        by_facet[static_cast<std::size_t>(patches.facet_idx(k))] +=
            light.patch_power_sr[static_cast<std::size_t>(k)];
      }
      const auto source = plane_entry(scene, led, {z_mm, 1.0}, 1.4);
      std::vector<double> drawn(mesh.triangles.size(), 0.0);
      constexpr int kSamples = 400000;
      RandomStream random(4, 0);
      for (int i = 0; i < kSamples; ++i) {
        const auto entry = source->sample((i + random.uniform()) / kSamples, random);
        if (!entry) continue;
        const RayHit hit =
            scene.first_hit(entry->position_mm - 1e-3 * entry->direction, entry->direction);
        drawn[static_cast<std::size_t>(hit.facet_idx)] += entry->power / kSamples;
      }
      const double all = test_support::total(light);
      for (std::size_t f = 0; f < drawn.size(); ++f) {
        EXPECT_NEAR(by_facet[f], drawn[f], 0.02 * drawn[f] + 0.003 * all) << f << " " << z_mm;
      }
    }
  }
}

}  // namespace
}  // namespace scattermeter
