#include "core/estimation/edge_light.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scattermeter {
namespace {

// A strip across the edge, from the middle of a piece of it, that receives what the piece loses:
// two triangles of uniform irradiance.
void add_strip(const Crease& edge, const Eigen::Vector3d& half_mm, const Eigen::Vector3d& middle_mm,
               double power_sr_per_mm, double width_mm, IncidentLight& light) {
  const Eigen::Vector3d aside = 0.5 * width_mm * edge.normals[0].cross(half_mm).normalized();
  const Eigen::Vector3d a = middle_mm - half_mm - aside, b = middle_mm + half_mm - aside,
                        c = middle_mm + half_mm + aside, d = middle_mm - half_mm + aside;
  const double irradiance = power_sr_per_mm / width_mm;
  for (const auto& corners : {std::array{a, b, c}, std::array{a, c, d}}) {
    light.lit.push_back({corners, {irradiance, irradiance, irradiance}, 0});
    light.patch_power_sr[0] += power_sr(light.lit.back());
  }
}

}  // namespace

double light_by_chamfer_per_mm(const Led& led, const Crease& edge, const Eigen::Vector3d& point_mm,
                               double eta_int_over_ext) {
  const auto e = [&](const Eigen::Vector3d& normal) {
    return led.transmitted_irradiance_per_mm2(point_mm, normal, eta_int_over_ext);
  };
  const Eigen::Vector3d sum = edge.normals[0] + edge.normals[1];
  const double length = sum.norm();
  if (!(length > 0.0)) return 0.0;
  return length * e(sum / length) - e(edge.normals[0]) - e(edge.normals[1]);
}

Eigen::MatrixXd change_by_edges(const SeenObject& seen, const Led& led, const DistanceKnots& knots,
                                const std::vector<LitMedium>& media) {
  const ObjectScene& object = *seen.object;
  const RayScene& shadows = seen.shadows != nullptr ? *seen.shadows : *object.rays;
  const double eta = object.stated->eta_int_over_ext;
  const double patch_mm = seen.patches->patch_size_mm();
  IncidentLight lost;
  lost.patch_power_sr = {0.0};
  for (const Crease& edge : creases(object.mesh(), kCrease_rad)) {
    const Eigen::Vector3d along_mm = edge.to_mm - edge.from_mm;
    const int pieces = std::max(1, static_cast<int>(std::ceil(along_mm.norm() / patch_mm)));
    const Eigen::Vector3d half_mm = 0.5 / pieces * along_mm;
    const Eigen::Vector3d outward = (edge.normals[0] + edge.normals[1]).normalized();
    for (int i = 0; i < pieces; ++i) {
      const Eigen::Vector3d middle_mm = edge.from_mm + (2 * i + 1) * half_mm;
      const double change = light_by_chamfer_per_mm(led, edge, middle_mm, eta);
      if (!(change < 0.0)) continue;
      if (shadows.occluded(middle_mm, outward, led.position_mm)) continue;
      add_strip(edge, half_mm, middle_mm, -change, 0.1 * patch_mm, lost);
    }
  }
  if (lost.lit.empty()) return {};
  return -images_at_centers(seen, lost, knots, media);
}

}  // namespace scattermeter
