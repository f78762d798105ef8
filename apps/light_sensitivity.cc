#include "apps/light_sensitivity.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/dipole.h"
#include "core/fresnel.h"
#include "core/incident_light.h"
#include "core/triangle_mesh.h"

namespace scattermeter::apps {
namespace {

constexpr double kExponentStep = 0.02;
constexpr double kEtaStep = 0.01;
constexpr double kTurnRad = 0.01;

// R on the knots, one column a medium, times its scale.
Eigen::MatrixXd curves(const std::vector<LitMedium>& media, const DistanceKnots& knots,
                       double eta) {
  Eigen::MatrixXd r(knots.size(), static_cast<Eigen::Index>(media.size()));
  for (std::size_t m = 0; m < media.size(); ++m) {
    Medium medium = media[m].medium;
    medium.eta_int_over_ext = eta;
    const Dipole dipole(medium);
    for (Eigen::Index i = 0; i < r.rows(); ++i) {
      r(i, static_cast<Eigen::Index>(m)) =
          media[m].scale *
          dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
    }
  }
  return r;
}

}  // namespace

std::array<Eigen::Vector3d, 2> tangents(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d first = normal.unitOrthogonal();
  return {first, normal.cross(first)};
}

namespace {

// Points on the object that stand for all rows of a view around them: the middle of the rows on
// each patch of a coarser mesh.
struct CoarseSites {
  std::vector<ExitSite> sites;
  std::vector<Eigen::Index> of_row;
};

CoarseSites coarse_sites(const SeenObject& seen, const PatchMesh& coarse) {
  const TriangleMesh& mesh = seen.object->mesh();
  CoarseSites out;
  std::map<int, Eigen::Index> site_of_patch;
  std::vector<double> rows;
  for (std::size_t j = 0; j < seen.sites.size(); ++j) {
    const Eigen::Vector3d& at_mm = seen.sites[j].center_mm;
    const int facet = seen.patches->facet_idx(seen.map.patch_of_row[j]);
    const int patch = coarse.locate(facet, barycentric(mesh, facet, at_mm)).patch_idx;
    const auto [it, is_new] =
        site_of_patch.try_emplace(patch, static_cast<Eigen::Index>(out.sites.size()));
    if (is_new) {
      out.sites.push_back(exit_point(Eigen::Vector3d::Zero()));
      rows.push_back(0.0);
    }
    const auto site = static_cast<std::size_t>(it->second);
    out.sites[site].center_mm += at_mm;
    rows[site] += 1.0;
    out.of_row.push_back(it->second);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out.sites[i] = exit_point(out.sites[i].center_mm / rows[i]);
  }
  return out;
}

// make(sites, sources, is_other_eta): of one change.
template <class Each, class Make>
Changed<Each> changed(const SeenObject& seen, const RigLight& rig_light, std::size_t channel,
                      ObjectLibrary& library, const Make& make) {
  const Led& led = rig_light.led;
  const ObjectScene& object = *seen.object;
  const double eta = object.rig->eta_int_over_ext;
  const PatchMesh coarse(object.mesh(), 2.0 * seen.patches->patch_size_mm());
  const auto lit_by = [&](const Led& light, double eta_here) {
    return SourceCloud(
        rig_light.environment
            ? library.environment_light(object.rig->name, rig_light.name, channel, coarse, eta_here)
            : illuminate(coarse, seen.shadows != nullptr ? *seen.shadows : *object.rays, light,
                         eta_here),
        object.box.center_mm());
  };
  Changed<Each> out;
  CoarseSites at = coarse_sites(seen, coarse);
  out.site_of_row = std::move(at.of_row);
  if (rig_light.is_ambient) {
    // What else is uncertain matters little to a small even light.
    return out;
  }
  const SourceCloud nominal = lit_by(led, eta);
  const auto under = [&](const Led& light, double eta_here) {
    return make(at.sites, lit_by(light, eta_here), eta_here != eta);
  };
  const bool is_calibrated = rig_light.calibrated.has_value();
  const bool position = is_calibrated || rig_light.position_std_mm > 0.0;
  const bool exponent = is_calibrated || rig_light.exponent_std > 0.0;
  const bool other_eta = object.rig->eta_std > 0.0;
  if (position || exponent || other_eta) out.nominal = make(at.sites, nominal, false);
  // A hundredth of the distance: shadow edges then move by several of the parts that patches are
  // cut into, and the next order is still a hundredth of the first.
  out.move_mm = 0.01 * (led.position_mm - object.box.center_mm()).norm();
  for (int i = 0; i < 3 && position; ++i) {
    Led other = led;
    other.position_mm[i] += out.move_mm;
    out.moved[static_cast<std::size_t>(i)] = under(other, eta);
  }
  if (exponent) {
    Led other = led;
    other.exponent += kExponentStep;
    out.other_exponent = under(other, eta);
  }
  out.turn_rad = kTurnRad;
  for (std::size_t t = 0; t < 2 && is_calibrated; ++t) {
    Led other = led;
    other.axis = (led.axis + kTurnRad * rig_light.calibrated->tangents[t]).normalized();
    out.turned[t] = under(other, eta);
  }
  if (other_eta) out.other_eta = under(led, eta + kEtaStep);
  // Where the sites are, row by row: beside edges and shadows the light changes from each to the
  // next.
  out.shift_mm = 0.1 * seen.patches->patch_size_mm();
  std::array<std::vector<ExitSite>, 3> sites;
  for (std::size_t j = 0; j < seen.sites.size(); ++j) {
    const ExitSite center = exit_point(seen.sites[j].center_mm);
    const auto along = tangents(seen.patches->normal(seen.map.patch_of_row[j]));
    sites[0].push_back(center);
    for (std::size_t t = 0; t < 2; ++t) {
      sites[t + 1].push_back(moved(center, out.shift_mm * along[t]));
    }
  }
  out.unshifted = make(sites[0], nominal, false);
  for (std::size_t t = 0; t < 2; ++t) out.shifted[t] = make(sites[t + 1], nominal, false);
  return out;
}

}  // namespace

PairSumOptions coarse_pair_options(const DistanceKnots& knots) {
  PairSumOptions pairs;
  pairs.floor_mm = 4.0 * knots.resolution_mm();
  pairs.far_ratio = 3.0;
  pairs.near_ratio = 0.7;
  return pairs;
}

ChangedWeights changed_weights(const SeenObject& seen, const RigLight& light, std::size_t channel,
                               ObjectLibrary& library, const DistanceKnots& knots) {
  const PairSumOptions pairs = coarse_pair_options(knots);
  return changed<WeightMatrix>(seen, light, channel, library,
                               [&](const std::vector<ExitSite>& sites, const SourceCloud& sources,
                                   bool) { return smooth_weights(sites, sources, knots, pairs); });
}

ChangedImages changed_images(const SeenObject& seen, const RigLight& light, std::size_t channel,
                             ObjectLibrary& library, const DistanceKnots& knots,
                             const std::vector<LitMedium>& media) {
  const PairSumOptions pairs = coarse_pair_options(knots);
  const double eta = seen.object->rig->eta_int_over_ext;
  const Eigen::MatrixXd r = curves(media, knots, eta);
  const Eigen::MatrixXd other = curves(media, knots, eta + kEtaStep);
  return changed<Eigen::MatrixXd>(
      seen, light, channel, library,
      [&](const std::vector<ExitSite>& sites, const SourceCloud& sources, bool is_other_eta) {
        return smooth_images(sites, sources, knots, pairs, is_other_eta ? other : r);
      });
}

ChangedImages changed_images(const SeenObject& seen, const ChangedWeights& weights,
                             const DistanceKnots& knots, const std::vector<LitMedium>& media) {
  const double eta = seen.object->rig->eta_int_over_ext;
  const Eigen::MatrixXd r = curves(media, knots, eta);
  const auto image = [&](const WeightMatrix& w) -> Eigen::MatrixXd {
    if (w.size() == 0) return {};
    return w * r;
  };
  ChangedImages out;
  out.nominal = image(weights.nominal);
  for (std::size_t i = 0; i < 3; ++i) out.moved[i] = image(weights.moved[i]);
  out.move_mm = weights.move_mm;
  out.other_exponent = image(weights.other_exponent);
  for (std::size_t t = 0; t < 2; ++t) out.turned[t] = image(weights.turned[t]);
  out.turn_rad = weights.turn_rad;
  if (weights.other_eta.size() > 0) {
    out.other_eta = weights.other_eta * curves(media, knots, eta + kEtaStep);
  }
  for (std::size_t t = 0; t < 2; ++t) out.shifted[t] = image(weights.shifted[t]);
  out.unshifted = image(weights.unshifted);
  out.shift_mm = weights.shift_mm;
  out.site_of_row = weights.site_of_row;
  return out;
}

LightSensitivity sensitivity(const SeenObject& seen, const WeightMatrix& nominal,
                             const ChangedImages& images, const std::vector<LitMedium>& media,
                             const DistanceKnots& knots) {
  const double eta = seen.object->rig->eta_int_over_ext;
  LightSensitivity out;
  out.l = nominal * curves(media, knots, eta);
  const auto relative = [](const Eigen::MatrixXd& changed, const Eigen::MatrixXd& from, double by) {
    return (from.array() > 0.0).select((changed - from).array() / (by * from.array()), 0.0).eval();
  };
  const auto change = [&](const Eigen::MatrixXd& changed, double by) -> Eigen::MatrixXd {
    if (changed.size() == 0) return {};
    return relative(changed, images.nominal, by)(images.site_of_row, Eigen::all) * out.l.array();
  };
  for (std::size_t i = 0; i < 3; ++i) out.per_mm[i] = change(images.moved[i], images.move_mm);
  out.per_exponent = change(images.other_exponent, kExponentStep);
  for (std::size_t t = 0; t < 2; ++t) out.per_rad[t] = change(images.turned[t], images.turn_rad);
  for (std::size_t t = 0; t < 2; ++t) {
    if (images.shifted[t].size() == 0) continue;
    out.per_tangent_mm[t] =
        relative(images.shifted[t], images.unshifted, images.shift_mm) * out.l.array();
  }
  out.per_eta = change(images.other_eta, kEtaStep);
  if (out.per_eta.size() == 0) return out;
  for (std::size_t j = 0; j < seen.sites.size(); ++j) {
    const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[j]);
    // The observed l = pi L / Ft(eta) falls as Ft grows.
    const Eigen::Vector3d to_camera =
        (seen.camera_center_mm - seen.sites[j].center_mm).normalized();
    const double cos_theta = normal.dot(to_camera);
    const double growth =
        fresnel_transmittance(eta, cos_theta) / fresnel_transmittance(eta + kEtaStep, cos_theta) -
        1.0;
    const auto row = static_cast<Eigen::Index>(j);
    out.per_eta.row(row) -= out.l.row(row) * (growth / kEtaStep);
  }
  return out;
}

}  // namespace scattermeter::apps
