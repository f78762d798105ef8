#include "apps/light_sensitivity.h"

#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/dipole.h"
#include "core/fresnel.h"
#include "core/incident_light.h"

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

// Bins between the knots: their error is the same before and after a change.
constexpr int kFineBits = 5;

// make(sites, sources, is_other_eta): of one change.
template <class Each, class Make>
Changed<Each> changed(const SeenObject& seen, const RigLight& rig_light, std::size_t channel,
                      ObjectLibrary& library, const Make& make) {
  Changed<Each> out;
  // What else is uncertain matters little to a small even light.
  if (rig_light.is_ambient) return out;
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
  std::array<std::vector<ExitSite>, 3> sites;
  out.shift_mm = 0.1 * seen.patches->patch_size_mm();
  for (std::size_t j = 0; j < seen.sites.size(); ++j) {
    const ExitSite center = exit_point(seen.sites[j].center_mm);
    const auto along = tangents(seen.patches->normal(seen.map.patch_of_row[j]));
    sites[0].push_back(center);
    for (std::size_t t = 0; t < 2; ++t) {
      sites[t + 1].push_back(moved(center, out.shift_mm * along[t]));
    }
  }
  const SourceCloud nominal = lit_by(led, eta);
  out.nominal = make(sites[0], nominal, false);
  for (std::size_t t = 0; t < 2; ++t) out.shifted[t] = make(sites[t + 1], nominal, false);
  const auto under = [&](const Led& light, double eta_here) {
    return make(sites[0], lit_by(light, eta_here), eta_here != eta);
  };
  // A hundredth of the distance: shadow edges then move by several of the parts that patches are
  // cut into, and the next order is still a hundredth of the first.
  out.move_mm = 0.01 * (led.position_mm - object.box.center_mm()).norm();
  const bool is_calibrated = rig_light.calibrated.has_value();
  for (int i = 0; i < 3 && (is_calibrated || rig_light.position_std_mm > 0.0); ++i) {
    Led other = led;
    other.position_mm[i] += out.move_mm;
    out.moved[static_cast<std::size_t>(i)] = under(other, eta);
  }
  if (is_calibrated || rig_light.exponent_std > 0.0) {
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
  if (object.rig->eta_std > 0.0) out.other_eta = under(led, eta + kEtaStep);
  return out;
}

}  // namespace

std::array<Eigen::Vector3d, 2> tangents(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d first = normal.unitOrthogonal();
  return {first, normal.cross(first)};
}

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
  const DistanceKnots few = knots.with_fine_bits(kFineBits);
  return changed<WeightMatrix>(seen, light, channel, library,
                               [&](const std::vector<ExitSite>& sites, const SourceCloud& sources,
                                   bool) { return smooth_weights(sites, sources, few, pairs); });
}

ChangedImages changed_images(const SeenObject& seen, const RigLight& light, std::size_t channel,
                             ObjectLibrary& library, const DistanceKnots& knots,
                             const std::vector<LitMedium>& media) {
  const PairSumOptions pairs = coarse_pair_options(knots);
  const DistanceKnots few = knots.with_fine_bits(kFineBits);
  const double eta = seen.object->rig->eta_int_over_ext;
  const Eigen::MatrixXd r = curves(media, knots, eta);
  const Eigen::MatrixXd other = curves(media, knots, eta + kEtaStep);
  return changed<Eigen::MatrixXd>(
      seen, light, channel, library,
      [&](const std::vector<ExitSite>& sites, const SourceCloud& sources, bool is_other_eta) {
        return smooth_images(sites, sources, few, pairs, is_other_eta ? other : r);
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
  out.shift_mm = weights.shift_mm;
  return out;
}

LightSensitivity sensitivity(const SeenObject& seen, const WeightMatrix& nominal,
                             const ChangedImages& images, const std::vector<LitMedium>& media,
                             const DistanceKnots& knots) {
  const double eta = seen.object->rig->eta_int_over_ext;
  LightSensitivity out;
  out.l = nominal * curves(media, knots, eta);
  const Eigen::MatrixXd& l = images.nominal;
  const auto change = [&](const Eigen::MatrixXd& changed, double by) -> Eigen::MatrixXd {
    if (changed.size() == 0) return {};
    const Eigen::ArrayXXd per_l = (changed - l).array() / (by * l.array());
    return (l.array() > 0.0).select(per_l * out.l.array(), 0.0);
  };
  for (std::size_t i = 0; i < 3; ++i) out.per_mm[i] = change(images.moved[i], images.move_mm);
  out.per_exponent = change(images.other_exponent, kExponentStep);
  for (std::size_t t = 0; t < 2; ++t) out.per_rad[t] = change(images.turned[t], images.turn_rad);
  for (std::size_t t = 0; t < 2; ++t) {
    out.per_tangent_mm[t] = change(images.shifted[t], images.shift_mm);
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
