#include "core/nuisances/edge_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/diffusion/source_cloud.h"

namespace scattermeter {
namespace {

// A rectangle of uniform irradiance: from one edge of it, a displacement to the opposite one.
void add_rectangle(const Eigen::Vector3d& from_mm, const Eigen::Vector3d& to_mm,
                   const Eigen::Vector3d& across_mm, double irradiance, IncidentLight& light) {
  if (!(irradiance > 0.0)) return;
  const Eigen::Vector3d a = from_mm + across_mm, b = to_mm + across_mm;
  for (const auto& corners : {std::array{from_mm, to_mm, b}, std::array{from_mm, b, a}}) {
    light.lit.push_back({corners, {irradiance, irradiance, irradiance}, 0});
    light.patch_power_sr[0] += power_sr(light.lit.back());
  }
}

// With chamfers of one width.
Eigen::MatrixXd change_by_chamfers(const SeenObject& seen, const Led& led,
                                   const DistanceKnots& knots, const std::vector<LitMedium>& media,
                                   double width_mm, WeightStore* store) {
  const ObjectScene& object = *seen.object;
  const RayScene& shadows = seen.shadowing();
  const double eta = object.stated->eta_int_over_ext;
  const double patch_mm = seen.patches->patch_size_mm();
  IncidentLight lost, gained;
  lost.patch_power_sr = gained.patch_power_sr = {0.0};
  for (const Crease& edge : creases(object.mesh(), kCrease_rad)) {
    const ChamferedEdge chamfer = chamfered(edge, width_mm);
    if (!chamfer.is_convex) continue;
    const Eigen::Vector3d along_mm = edge.to_mm - edge.from_mm;
    const int pieces = std::max(1, static_cast<int>(std::ceil(along_mm.norm() / patch_mm)));
    for (int i = 0; i < pieces; ++i) {
      const Eigen::Vector3d from_mm = edge.from_mm + (1.0 * i / pieces) * along_mm;
      const Eigen::Vector3d to_mm = edge.from_mm + ((i + 1.0) / pieces) * along_mm;
      const Eigen::Vector3d middle_mm = 0.5 * (from_mm + to_mm);
      if (shadows.occluded(middle_mm, chamfer.normal, led.position_mm)) continue;
      const auto e = [&](const Eigen::Vector3d& normal) {
        return led.transmitted_irradiance_per_mm2(middle_mm, normal, eta);
      };
      for (std::size_t k = 0; k < 2; ++k) {
        add_rectangle(from_mm, to_mm, chamfer.inward_mm[k], e(edge.normals[k]), lost);
      }
      const Eigen::Vector3d& first_mm = chamfer.inward_mm[0];
      add_rectangle(from_mm + first_mm, to_mm + first_mm, chamfer.inward_mm[1] - first_mm,
                    e(chamfer.normal), gained);
    }
  }
  if (lost.lit.empty() && gained.lit.empty()) return {};
  // Of patches beside an edge, the mean: at their centres the light of an edge that decays within
  // a patch is too small.
  const auto image = [&](const IncidentLight& light) -> Eigen::MatrixXd {
    const auto rows = static_cast<Eigen::Index>(seen.sites.size());
    if (light.lit.empty()) {
      return Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(media.size()));
    }
    return coarse_images(object, seen.sites, light, knots, media, store);
  };
  return (image(gained) - image(lost)) / width_mm;
}

}  // namespace

ChamferedEdge chamfered(const Crease& edge, double width_mm) {
  const Eigen::Vector3d along = (edge.to_mm - edge.from_mm).normalized();
  ChamferedEdge out;
  // The edge runs counterclockwise about the second facet.
  out.inward_mm = {width_mm * along.cross(edge.normals[0]),
                   width_mm * edge.normals[1].cross(along)};
  out.normal = (edge.normals[0] + edge.normals[1]).normalized();
  out.is_convex = out.inward_mm[0].dot(edge.normals[1]) < 0.0;
  return out;
}

Eigen::MatrixXd change_by_edges(const SeenObject& seen, const Led& led, const DistanceKnots& knots,
                                const std::vector<LitMedium>& media,
                                const std::vector<double>& widths_mm, WeightStore* store) {
  std::map<double, std::vector<Eigen::Index>> of_width;
  for (std::size_t m = 0; m < media.size(); ++m) {
    of_width[widths_mm.at(m)].push_back(static_cast<Eigen::Index>(m));
  }
  Eigen::MatrixXd out;
  for (const auto& [width_mm, columns] : of_width) {
    std::vector<LitMedium> some;
    for (const Eigen::Index m : columns) some.push_back(media[static_cast<std::size_t>(m)]);
    const Eigen::MatrixXd change = change_by_chamfers(seen, led, knots, some, width_mm, store);
    if (change.size() == 0) return {};
    out.resize(change.rows(), static_cast<Eigen::Index>(media.size()));
    out(Eigen::all, columns) = change;
  }
  return out;
}

double chamfer_width_mm(const SceneObject& object) {
  constexpr double kOfExactEdges_mm = 0.05;
  constexpr double kDeviations = 1.5;
  return object.edge_std_mm > 0.0 ? kDeviations * object.edge_std_mm : kOfExactEdges_mm;
}

}  // namespace scattermeter
