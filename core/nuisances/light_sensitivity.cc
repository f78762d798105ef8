#include "core/nuisances/light_sensitivity.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/tangents.h"
#include "core/light/incident_light.h"
#include "core/material/dipole.h"
#include "core/material/eta_change.h"

namespace scattermeter {

DistanceKnots coarse_knots(const DistanceKnots& knots) {
  constexpr int kPerOctave = 3, kFineBits = 5;
  return {knots.resolution_mm(), knots.max_distance_mm(), kPerOctave, kFineBits};
}

namespace {

// A view's object under a light, on patches of twice the size.
class CoarseLight {
 public:
  CoarseLight(const SeenObject& seen, const SceneLight& light, std::size_t channel, LitObjects& lit)
      : seen_(seen),
        light_(light),
        channel_(channel),
        lit_(lit),
        coarse_(seen.object->mesh(), 2.0 * seen.patches->patch_size_mm()) {}
  SourceCloud by(const Light& other, double eta) const {
    return SourceCloud(
        other.illuminate(coarse_, seen_.shadowing(), eta, LightUse::kMeasure)[channel_],
        seen_.object->box.center_mm());
  }
  // A light with different channels computes all of them at once; they are kept for the other
  // channels.
  SourceCloud nominal(double eta) const {
    if (light_->channels() == 1) return by(*light_, eta);
    return SourceCloud(lit_.light_on(seen_.object->stated->name, light_, channel_, coarse_, eta),
                       seen_.object->box.center_mm());
  }

 private:
  const SeenObject& seen_;
  const SceneLight& light_;
  std::size_t channel_;
  LitObjects& lit_;
  PatchMesh coarse_;
};

// Per unit of the quantity that changes by `by`, relative to l.
Eigen::MatrixXd relative_change(const Eigen::MatrixXd& changed, const Eigen::MatrixXd& l,
                                double by) {
  return (l.array() > 0.0).select((changed - l).array() / (by * l.array()), 0.0);
}

// What eta changes in the l that are observed for the same radiance, by growth g a unit, taken off
// the change r of those that are predicted: (1 + s r) / (1 + s g) = 1 + s (r - g) / (1 + s g).
void take_off_observed(const SeenObject& seen, const Eigen::MatrixXd& l, double step,
                       Eigen::MatrixXd& per_eta) {
  for (std::size_t j = 0; j < seen.sites.size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    const double growth =
        observed_growth(seen.object->stated->eta_int_over_ext, seen.cos_to_camera(j), step);
    per_eta.row(row) = (per_eta.row(row) - growth * l.row(row)) / (1.0 + step * growth);
  }
}

// make(sites, sources, is_other_eta): of one change.
template <class Each, class Make>
Changed<Each> changed(const SeenObject& seen, const SceneLight& light, std::size_t channel,
                      LitObjects& lit, const Make& make) {
  Changed<Each> out;
  if (light->is_fitted()) return out;
  const ObjectScene& object = *seen.object;
  const double eta = object.stated->eta_int_over_ext;
  const CoarseLight coarse(seen, light, channel, lit);
  std::array<std::vector<ExitSite>, 3> sites;
  sites[0] = sites_at_centers(seen);
  out.shift_mm = 0.1 * seen.patches->patch_size_mm();
  std::vector<Eigen::Vector3d> centers_mm, normals;
  for (std::size_t j = 0; j < seen.sites.size(); ++j) {
    centers_mm.push_back(seen.sites[j].center_mm);
    normals.push_back(seen.patches->normal(seen.map.patch_of_row[j]));
    const auto along = tangents(normals.back());
    for (std::size_t t = 0; t < 2; ++t) {
      sites[t + 1].push_back(moved(sites[0][j], out.shift_mm * along[t]));
    }
  }
  // Few rows are far apart for the size of the object.
  constexpr std::size_t kManyRows = 1000;
  out.some =
      interpolation_of_rows(centers_mm, normals,
                            centers_mm.size() < kManyRows ? std::vector<std::vector<std::int32_t>>()
                                                          : seen.map.adjacent_rows);
  std::vector<ExitSite> some;
  for (const std::size_t row : out.some.rows) some.push_back(sites[0][row]);
  const SourceCloud sources = coarse.nominal(eta);
  out.nominal = make(sites[0], sources, false);
  for (std::size_t t = 0; t < 2; ++t) out.shifted[t] = make(sites[t + 1], sources, false);
  for (const LightChange& change : light->changes(object.box.center_mm())) {
    out.changed.push_back(make(some, coarse.by(*change.changed, eta), false));
    out.steps.push_back(change.step);
  }
  out.other_eta = make(some, coarse.nominal(eta + kEtaStep), true);
  return out;
}

}  // namespace

LitMedium lit_medium(const Estimate& first) {
  return {{first.sigma_s_prime_per_mm.value, first.sigma_a_per_mm.value, 1.0}, first.scale.value};
}

Eigen::MatrixXd scaled_curves(const std::vector<LitMedium>& media, const DistanceKnots& knots,
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

PairSumOptions coarse_pair_options(const DistanceKnots& knots) {
  PairSumOptions pairs;
  pairs.floor_mm = 4.0 * knots.resolution_mm();
  pairs.far_ratio = 3.0;
  pairs.near_ratio = 0.7;
  return pairs;
}

ChangedWeights changed_weights(const SeenObject& seen, const SceneLight& light, std::size_t channel,
                               LitObjects& lit, const DistanceKnots& knots, WeightStore* store) {
  const PairSumOptions pairs = coarse_pair_options(knots);
  const DistanceKnots few = coarse_knots(knots);
  return changed<WeightMatrix>(
      seen, light, channel, lit,
      [&](const std::vector<ExitSite>& sites, const SourceCloud& sources, bool) {
        return smooth_weights(sites, sources, few, pairs, store);
      });
}

ChangedImages changed_images(const SeenObject& seen, const SceneLight& light, std::size_t channel,
                             LitObjects& lit, const DistanceKnots& knots,
                             const std::vector<LitMedium>& media) {
  const PairSumOptions pairs = coarse_pair_options(knots);
  const DistanceKnots few = coarse_knots(knots);
  const double eta = seen.object->stated->eta_int_over_ext;
  const Eigen::MatrixXd r = scaled_curves(media, few, eta);
  const Eigen::MatrixXd other = scaled_curves(media, few, eta + kEtaStep);
  return changed<Eigen::MatrixXd>(
      seen, light, channel, lit,
      [&](const std::vector<ExitSite>& sites, const SourceCloud& sources, bool is_other_eta) {
        return smooth_images(sites, sources, few, pairs, is_other_eta ? other : r);
      });
}

ChangedImages changed_images(const SeenObject& seen, const ChangedWeights& weights,
                             const DistanceKnots& knots, const std::vector<LitMedium>& media) {
  const double eta = seen.object->stated->eta_int_over_ext;
  const DistanceKnots few = coarse_knots(knots);
  const Eigen::MatrixXd r = scaled_curves(media, few, eta);
  const auto image = [&](const WeightMatrix& w) -> Eigen::MatrixXd {
    if (w.size() == 0) return {};
    return w * r;
  };
  ChangedImages out;
  out.nominal = image(weights.nominal);
  out.some = weights.some;
  for (const WeightMatrix& w : weights.changed) out.changed.push_back(image(w));
  out.steps = weights.steps;
  if (weights.other_eta.size() > 0) {
    out.other_eta = weights.other_eta * scaled_curves(media, few, eta + kEtaStep);
  }
  for (std::size_t t = 0; t < 2; ++t) out.shifted[t] = image(weights.shifted[t]);
  out.shift_mm = weights.shift_mm;
  return out;
}

std::vector<ExitSite> sites_at_centers(const SeenObject& seen) {
  std::vector<ExitSite> sites;
  sites.reserve(seen.sites.size());
  for (const ExitSite& site : seen.sites) sites.push_back(exit_point(site.center_mm));
  return sites;
}

Eigen::MatrixXd coarse_images(const ObjectScene& object, const std::vector<ExitSite>& sites,
                              const IncidentLight& light, const DistanceKnots& knots,
                              const std::vector<LitMedium>& media, WeightStore* store) {
  const SourceCloud sources(light, object.box.center_mm());
  const DistanceKnots few = coarse_knots(knots);
  return smooth_weights(sites, sources, few, coarse_pair_options(knots), store) *
         scaled_curves(media, few, object.stated->eta_int_over_ext);
}

LightSensitivity sensitivity(const SeenObject& seen, const WeightMatrix& nominal,
                             const ChangedImages& images, const std::vector<LitMedium>& media,
                             const DistanceKnots& knots) {
  const double eta = seen.object->stated->eta_int_over_ext;
  LightSensitivity out;
  out.l = nominal * scaled_curves(media, knots, eta);
  const Eigen::MatrixXd& l = images.nominal;
  const Eigen::MatrixXd some_l = l(images.some.rows, Eigen::all);
  const auto of_light = [&](const Eigen::MatrixXd& changed, double by) -> Eigen::MatrixXd {
    if (changed.size() == 0) return {};
    const Eigen::MatrixXd all = images.some.from_rows * relative_change(changed, some_l, by);
    return all.cwiseProduct(out.l);
  };
  for (std::size_t k = 0; k < images.changed.size(); ++k) {
    out.per_change.push_back(of_light(images.changed[k], images.steps[k]));
  }
  if (l.size() > 0) {
    for (std::size_t t = 0; t < 2; ++t) {
      out.per_tangent_mm[t] =
          relative_change(images.shifted[t], l, images.shift_mm).cwiseProduct(out.l);
    }
  }
  out.per_eta = of_light(images.other_eta, kEtaStep);
  if (out.per_eta.size() > 0) take_off_observed(seen, out.l, kEtaStep, out.per_eta);
  return out;
}

void set_far_per_eta(const SeenObject& seen, const SceneLight& light, std::size_t channel,
                     LitObjects& lit, const DistanceKnots& knots,
                     const std::vector<LitMedium>& media, const std::vector<double>& offsets,
                     LightSensitivity& sensitivity) {
  std::map<double, std::vector<Eigen::Index>> of_offset;
  for (std::size_t m = 0; m < media.size(); ++m) {
    if (offsets.at(m) != 0.0) of_offset[offsets[m]].push_back(static_cast<Eigen::Index>(m));
  }
  if (light->is_fitted() || of_offset.empty()) return;
  const double eta = seen.object->stated->eta_int_over_ext;
  const PairSumOptions pairs = coarse_pair_options(knots);
  const DistanceKnots few = coarse_knots(knots);
  const std::vector<ExitSite> sites = sites_at_centers(seen);
  const CoarseLight coarse(seen, light, channel, lit);
  const auto image = [&](const SourceCloud& sources, double eta_here,
                         const std::vector<LitMedium>& some) {
    return smooth_images(sites, sources, few, pairs, scaled_curves(some, few, eta_here));
  };
  const SourceCloud nominal = coarse.nominal(eta);
  for (const auto& [offset, columns] : of_offset) {
    std::vector<LitMedium> some;
    for (const Eigen::Index m : columns) some.push_back(media[static_cast<std::size_t>(m)]);
    const Eigen::MatrixXd l = sensitivity.l(Eigen::all, columns);
    const double there = eta + offset;
    Eigen::MatrixXd per_eta = relative_change(image(coarse.nominal(there), there, some),
                                              image(nominal, eta, some), offset)
                                  .cwiseProduct(l);
    take_off_observed(seen, l, offset, per_eta);
    sensitivity.per_eta(Eigen::all, columns) = per_eta;
  }
}

}  // namespace scattermeter
