#include "core/mesh/ray_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <Eigen/Geometry>

#include "core/mesh/convexity.h"

namespace scattermeter {

struct RayScene::Embree {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  ~Embree() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

RayScene::RayScene(const TriangleMesh& mesh)
    : mesh_(mesh),
      center_mm_(bounds(mesh).center_mm()),
      size_mm_(bounds(mesh).size_mm().maxCoeff()),
      convex_(is_convex(mesh)),
      embree_(std::make_unique<Embree>()) {
  embree_->device = rtcNewDevice(nullptr);
  if (embree_->device == nullptr) throw std::runtime_error("RayScene: Embree has no device");
  embree_->scene = rtcNewScene(embree_->device);
  // Watertight at shared edges and vertices.
  rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             mesh_.vertices_mm.size()));
  auto* index = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh_.triangles.size()));
  if (vertex == nullptr || index == nullptr) {
    rtcReleaseGeometry(geometry);
    throw std::runtime_error("RayScene: Embree has no memory for the mesh");
  }
  for (const Eigen::Vector3d& v : mesh_.vertices_mm) {
    for (int i = 0; i < 3; ++i) *vertex++ = static_cast<float>(v[i] - center_mm_[i]);
  }
  for (const auto& t : mesh_.triangles) {
    for (int i : t) *index++ = static_cast<unsigned>(i);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(embree_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(embree_->scene);
  if (const RTCError error = rtcGetDeviceError(embree_->device); error != RTC_ERROR_NONE) {
    throw std::runtime_error("RayScene: Embree error " + std::to_string(static_cast<int>(error)));
  }
}

RayScene::~RayScene() = default;

namespace {

RayHit hit_of(unsigned facet, float u, float v, double distance) {
  RayHit hit;
  hit.facet_idx = static_cast<int>(facet);
  hit.barycentric = {1.0 - double(u) - double(v), double(u), double(v)};
  hit.distance = distance;
  return hit;
}

}  // namespace

RayScene::Start RayScene::start_of(const Eigen::Vector3d& origin_mm,
                                   const Eigen::Vector3d& direction) const {
  const Eigen::Vector3d from_center_mm = origin_mm - center_mm_;
  Start start;
  start.length = direction.norm();
  start.unit = direction / start.length;
  start.skip_mm = std::max(0.0, -from_center_mm.dot(start.unit) - 2.0 * size_mm_);
  start.at_mm = from_center_mm + start.skip_mm * start.unit;
  return start;
}

RayHit RayScene::first_hit(const Eigen::Vector3d& origin_mm,
                           const Eigen::Vector3d& direction) const {
  const Start start = start_of(origin_mm, direction);
  RayHit hit = hit_between(start.at_mm, start.unit, 0.0F, std::numeric_limits<float>::infinity());
  if (hit.facet_idx >= 0) hit.distance = (start.skip_mm + hit.distance) / start.length;
  return hit;
}

void RayScene::first_hits(const Eigen::Vector3d& origin_mm,
                          std::span<const Eigen::Vector3f> directions,
                          std::span<RayHit> hits) const {
  constexpr std::size_t kRays = 16;
  for (std::size_t first = 0; first < directions.size(); first += kRays) {
    const std::size_t n = std::min(kRays, directions.size() - first);
    RTCRayHit16 query{};
    alignas(64) std::array<int, kRays> valid{};
    std::array<Start, kRays> starts;
    for (std::size_t i = 0; i < n; ++i) {
      const Eigen::Vector3f& direction = directions[first + i];
      hits[first + i] = {};
      if (!direction.allFinite()) continue;
      starts[i] = start_of(origin_mm, direction.cast<double>());
      valid[i] = -1;
      query.ray.org_x[i] = static_cast<float>(starts[i].at_mm.x());
      query.ray.org_y[i] = static_cast<float>(starts[i].at_mm.y());
      query.ray.org_z[i] = static_cast<float>(starts[i].at_mm.z());
      query.ray.dir_x[i] = static_cast<float>(starts[i].unit.x());
      query.ray.dir_y[i] = static_cast<float>(starts[i].unit.y());
      query.ray.dir_z[i] = static_cast<float>(starts[i].unit.z());
      query.ray.tfar[i] = std::numeric_limits<float>::infinity();
      query.ray.mask[i] = 0xFFFFFFFFU;
      query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect16(valid.data(), embree_->scene, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid.data(), embree_->scene, &context, &query);
#endif
    for (std::size_t i = 0; i < n; ++i) {
      if (valid[i] == 0 || query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      hits[first + i] = hit_of(query.hit.primID[i], query.hit.u[i], query.hit.v[i],
                               (starts[i].skip_mm + double(query.ray.tfar[i])) / starts[i].length);
    }
  }
}

RayHit RayScene::first_hit_between(const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& unit,
                                   double near_mm, double far_mm) const {
  return hit_between(origin_mm - center_mm_, unit, static_cast<float>(near_mm),
                     static_cast<float>(far_mm));
}

RayHit RayScene::hit_between(const Eigen::Vector3d& start_mm, const Eigen::Vector3d& unit,
                             float near_mm, float far_mm) const {
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(start_mm.x());
  query.ray.org_y = static_cast<float>(start_mm.y());
  query.ray.org_z = static_cast<float>(start_mm.z());
  query.ray.dir_x = static_cast<float>(unit.x());
  query.ray.dir_y = static_cast<float>(unit.y());
  query.ray.dir_z = static_cast<float>(unit.z());
  query.ray.tnear = near_mm;
  query.ray.tfar = far_mm;
  query.ray.mask = 0xFFFFFFFFU;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
  rtcIntersect1(embree_->scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect1(embree_->scene, &context, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return hit_of(query.hit.primID, query.hit.u, query.hit.v, double(query.ray.tfar));
}

bool RayScene::occluded(const Eigen::Vector3d& surface_mm, const Eigen::Vector3d& normal,
                        const Eigen::Vector3d& target_mm) const {
  const Eigen::Vector3d start_mm = surface_mm - center_mm_ + 1e-5 * size_mm_ * normal;
  const Eigen::Vector3d to_target_mm = target_mm - center_mm_ - start_mm;
  const double distance_mm = to_target_mm.norm();
  return occluded_between(start_mm, to_target_mm / distance_mm, distance_mm);
}

bool RayScene::occluded_toward(const Eigen::Vector3d& surface_mm, const Eigen::Vector3d& normal,
                               const Eigen::Vector3d& direction) const {
  return occluded_between(surface_mm - center_mm_ + 1e-5 * size_mm_ * normal,
                          direction.normalized(), std::numeric_limits<double>::infinity());
}

// `start_mm`: relative to the centre.
bool RayScene::occluded_between(const Eigen::Vector3d& start_mm, const Eigen::Vector3d& unit,
                                double distance_mm) const {
  RTCRay ray{};
  ray.org_x = static_cast<float>(start_mm.x());
  ray.org_y = static_cast<float>(start_mm.y());
  ray.org_z = static_cast<float>(start_mm.z());
  ray.dir_x = static_cast<float>(unit.x());
  ray.dir_y = static_cast<float>(unit.y());
  ray.dir_z = static_cast<float>(unit.z());
  ray.tnear = 0.0F;
  ray.tfar = static_cast<float>(distance_mm);
  ray.mask = 0xFFFFFFFFU;
#if RTC_VERSION_MAJOR >= 4
  rtcOccluded1(embree_->scene, &ray);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(embree_->scene, &context, &ray);
#endif
  return ray.tfar < 0.0F;
}

bool RayScene::contains(const Eigen::Vector3d& point_mm) const {
  // Van Oosterom and Strackee 1983: solid angle of a triangle; the sum is 4 pi inside, 0 outside.
  double solid_angle = 0.0;
  for (const auto& t : mesh_.triangles) {
    const Eigen::Vector3d a = mesh_.vertices_mm[t[0]] - point_mm;
    const Eigen::Vector3d b = mesh_.vertices_mm[t[1]] - point_mm;
    const Eigen::Vector3d c = mesh_.vertices_mm[t[2]] - point_mm;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    const double numerator = a.dot(b.cross(c));
    const double denominator = la * lb * lc + a.dot(b) * lc + a.dot(c) * lb + b.dot(c) * la;
    solid_angle += 2.0 * std::atan2(numerator, denominator);
  }
  return solid_angle > 2.0 * std::numbers::pi;
}

}  // namespace scattermeter
