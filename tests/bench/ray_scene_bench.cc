// Shadow rays beside bare Embree: the same rays, the same tree.
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "core/mesh/ray_scene.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

constexpr int kRays = 1 << 14;

// Two spheres, so that the scene is not convex and every ray counts.
TriangleMesh two_spheres() {
  TriangleMesh mesh = test_support::make_sphere(10.0, 5);
  const auto first = static_cast<int>(mesh.vertices_mm.size());
  const TriangleMesh other = mesh;
  for (const Eigen::Vector3d& v : other.vertices_mm) {
    mesh.vertices_mm.push_back(v + Eigen::Vector3d(25, 0, 0));
  }
  for (const auto& t : other.triangles) {
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return mesh;
}

struct Rays {
  std::vector<Eigen::Vector3d> point, normal;
  Eigen::Vector3d light{60, -40, 80};
};

// From points of the surface to one light.
Rays shadow_rays() {
  Rays rays;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  while (rays.point.size() < kRays) {
    const Eigen::Vector3d n =
        Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    if (n.dot(rays.light - 10.0 * n) < 0.0) continue;
    rays.point.push_back(10.0 * n);
    rays.normal.push_back(n);
  }
  return rays;
}

void occluded(benchmark::State& state) {
  const RayScene scene(two_spheres());
  const Rays rays = shadow_rays();
  for (auto _ : state) {
    int hits = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
      hits += scene.occluded(rays.point[i], rays.normal[i], rays.light) ? 1 : 0;
    }
    benchmark::DoNotOptimize(hits);
  }
  state.SetItemsProcessed(state.iterations() * kRays);
}
BENCHMARK(occluded);

void occluded_bare_embree(benchmark::State& state) {
  const TriangleMesh mesh = two_spheres();
  const RTCDevice device = rtcNewDevice(nullptr);
  const RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             mesh.vertices_mm.size()));
  for (const Eigen::Vector3d& v : mesh.vertices_mm) {
    for (const double x : v) *vertex++ = static_cast<float>(x);
  }
  auto* index = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (const int i : t) *index++ = static_cast<unsigned>(i);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  const Rays rays = shadow_rays();
  std::vector<RTCRay> ready;
  for (std::size_t i = 0; i < kRays; ++i) {
    const Eigen::Vector3d from = rays.point[i] + 1e-4 * rays.normal[i];
    const Eigen::Vector3d to = rays.light - from;
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x());
    ray.org_y = static_cast<float>(from.y());
    ray.org_z = static_cast<float>(from.z());
    ray.dir_x = static_cast<float>(to.normalized().x());
    ray.dir_y = static_cast<float>(to.normalized().y());
    ray.dir_z = static_cast<float>(to.normalized().z());
    ray.tfar = static_cast<float>(to.norm());
    ray.mask = 0xFFFFFFFFU;
    ready.push_back(ray);
  }
  for (auto _ : state) {
    int hits = 0;
    for (const RTCRay& of : ready) {
      RTCRay ray = of;
#if RTC_VERSION_MAJOR >= 4
      rtcOccluded1(scene, &ray);
#else
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcOccluded1(scene, &context, &ray);
#endif
      hits += ray.tfar < 0.0F ? 1 : 0;
    }
    benchmark::DoNotOptimize(hits);
  }
  state.SetItemsProcessed(state.iterations() * kRays);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}
BENCHMARK(occluded_bare_embree);

}  // namespace
}  // namespace scattermeter
