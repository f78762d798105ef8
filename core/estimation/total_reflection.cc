#include "core/estimation/total_reflection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include <Eigen/Geometry>

#include "core/material/eta_change.h"
#include "core/material/fresnel.h"
#include "core/material/smooth_boundary.h"
#include "core/mesh/triangle_mesh.h"

namespace scattermeter {
namespace {

constexpr double kMostBend = 0.01;  // of a row's light
constexpr double kReach = 5.0;      // mean free paths: a hundredth gets farther

}  // namespace

double bend_of_inner_reflection(const RayScene& object, const Eigen::Vector3d& point_mm,
                                const Eigen::Vector3d& normal, const Eigen::Vector3d& to,
                                const UncertainIndex& index, double mean_free_path_mm) {
  if (!(to.dot(normal) > 0.0) || !(index.std > 0.0)) return 0.0;
  const double eta = index.eta_int_over_ext;
  const RayHit hit = object.first_hit_between(point_mm, refracted(-to, normal, eta),
                                              1e-4 * object.size_mm(), kReach * mean_free_path_mm);
  if (hit.facet_idx < 0) return 0.0;
  const Eigen::Vector3d face = area_vector_mm2(object.mesh(), hit.facet_idx).normalized();
  const auto reflectance = [&](double at_eta) {
    // Where it would be less than outside, nothing is refracted.
    const double index_then = std::max(at_eta, 1.0);
    return 1.0 -
           fresnel_transmittance(1.0 / index_then, face.dot(refracted(-to, normal, index_then)));
  };
  const double nominal = reflectance(eta);
  const double slope = (reflectance(eta + kEtaStep) - nominal) / kEtaStep;
  double bend = 0.0;
  for (const double deviations : {-2.0, -1.0, 1.0, 2.0}) {
    const double change = deviations * index.std;
    bend = std::max(bend, std::abs(reflectance(eta + change) - nominal - slope * change));
  }
  return bend * std::exp(-hit.distance / mean_free_path_mm);
}

std::vector<Eigen::Index> near_total_reflection(const Scene& scene, const MaterialChannel& channel,
                                                const ChannelRows& rows, double mean_free_path_mm) {
  std::vector<std::vector<Eigen::Vector3d>> ends_mm;  // of rays from a shot's rows
  for (const ObservedShot* shot : channel.shots) {
    ends_mm.push_back({shot->seen->camera_center_mm});
    for (const std::string& name : shot->stated->lights) {
      const LedLight* led = scene.light(name).led();
      if (led != nullptr) ends_mm.back().push_back(led->led.position_mm);
    }
  }
  std::vector<Eigen::Index> near;
  Eigen::Index at = 0;
  for_used_rows(rows, [&](std::size_t s, std::size_t j) {
    const SeenObject& seen = *channel.shots[s]->seen;
    const UncertainIndex index{channel.eta_int_over_ext, seen.object->stated->eta_std};
    const Eigen::Vector3d& at_mm = seen.sites[j].center_mm;
    const Eigen::Vector3d normal = seen.patches->normal_at(seen.map.patch_of_row[j], at_mm);
    const auto bends = [&](const Eigen::Vector3d& end_mm) {
      return bend_of_inner_reflection(*seen.object->rays, at_mm, normal,
                                      (end_mm - at_mm).normalized(), index,
                                      mean_free_path_mm) > kMostBend;
    };
    if (std::any_of(ends_mm[s].begin(), ends_mm[s].end(), bends)) near.push_back(at);
    ++at;
  });
  return near;
}

}  // namespace scattermeter
