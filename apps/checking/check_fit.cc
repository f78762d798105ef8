#include "apps/checking/check_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "apps/checking/edge_rows.h"
#include "apps/checking/transport_departures.h"
#include "apps/instrument/fitted_view.h"
#include "capture/shots/shot_samples.h"
#include "core/base/progress.h"
#include "core/base/stopwatch.h"
#include "core/diffusion/dipole_curve.h"
#include "core/estimation/contradictions.h"
#include "core/estimation/estimation.h"
#include "core/estimation/model_choice.h"
#include "core/estimation/transport_search.h"
#include "core/estimation/transport_start.h"
#include "core/fit/prior_pulls.h"
#include "core/nuisances/view_shift.h"
#include "core/view/row_selection.h"

namespace scattermeter::apps {
namespace {

std::vector<MaterialChannel> useful_channels(const Rig& rig,
                                             const std::vector<ObservedShot>& shots) {
  std::vector<MaterialChannel> channels;
  for (MaterialChannel& c : material_channels(rig.scene, shots)) {
    std::erase_if(c.shots,
                  [&](const ObservedShot* s) { return !shot_problem(*s, c.channel).empty(); });
    if (!c.shots.empty()) channels.push_back(std::move(c));
  }
  return channels;
}

// Transport is searched for as long as by `measure`, so that both judge by the same evidence.
constexpr double kTransport_s = 20.0;

// A column of the rows of the model that measures, on the rows of the dipole's system; NaN where it
// was not used.
Eigen::VectorXd on_rows_of(const DipoleSystem& of_dipole, const ChannelResult& result,
                           std::vector<float> ShotRows::*column) {
  std::vector<double> out;
  for (std::size_t s = 0; s < of_dipole.rows->size(); ++s) {
    const ChannelObservation& o = (*of_dipole.rows)[s];
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      out.push_back(s < result.rows.size() ? static_cast<double>((result.rows[s].*column)[j])
                                           : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return Eigen::Map<const Eigen::VectorXd>(out.data(), static_cast<Eigen::Index>(out.size()));
}

// rms of the residual beside the edges of the mesh over that elsewhere.
double edge_excess(const std::vector<const ObservedShot*>& shots, const DipoleSystem& of_dipole,
                   const std::vector<Eigen::Index>& kept, const DenseSystem& system,
                   const LinearModel& model) {
  double squares[2] = {0.0, 0.0};
  double n[2] = {0.0, 0.0};
  auto next = kept.begin();
  Eigen::Index at = 0;
  Eigen::Index row = 0;
  for (std::size_t s = 0; s < of_dipole.rows->size(); ++s) {
    const ChannelObservation& o = (*of_dipole.rows)[s];
    const SeenObject& seen = *shots[s]->seen;
    std::vector<Eigen::Vector3d> centers_mm;
    for (const ExitSite& site : seen.sites) centers_mm.push_back(site.center_mm);
    const std::vector<bool> beside =
        beside_edges(seen.object->mesh(), centers_mm, 2.0 * seen.patches->patch_size_mm());
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      if (next != kept.end() && *next == at++) {
        ++next;
        const std::size_t k = beside[j] ? 1 : 0;
        squares[k] += std::pow((system.l[row] - model.predicted[row]) / system.l[row], 2);
        n[k] += 1.0;
        ++row;
      }
    }
  }
  constexpr double kLeastRows = 20.0;
  if (n[0] < kLeastRows || n[1] < kLeastRows || !(squares[0] > 0.0)) return 0.0;
  return std::sqrt(squares[1] / n[1] / (squares[0] / n[0]));
}

// Adds the departures of each shot from the joint model at its optimum, and their causes.
void add_departures(const Scene& stated, const Scene& scene, const DipoleSystem& of_dipole,
                    const MaterialChannel& channel, const ChannelResult& result,
                    CheckedChannel& fitted) {
  const Estimate& e = fitted.estimate;
  const double sigma_t = e.sigma_s_prime_per_mm.value + e.sigma_a_per_mm.value;
  const DipoleCurve curve =
      dipole_curve(of_dipole.knots, std::log(sigma_t), e.sigma_a_per_mm.value / sigma_t,
                   channel.eta_int_over_ext);
  DenseSystem all = of_dipole.system();
  const bool by_transport = result.model == "transport";
  const Eigen::VectorXd predicted = by_transport
                                        ? on_rows_of(of_dipole, result, &ShotRows::predicted)
                                        : Eigen::VectorXd(all.weights * (e.scale.value * curve.r));
  if (predicted.size() != all.l.size()) return;
  // That of its paths, too.
  if (by_transport) all.std_l = on_rows_of(of_dipole, result, &ShotRows::std);
  std::vector<Eigen::Index> known;
  for (Eigen::Index j = 0; j < all.l.size(); ++j) {
    if (std::isfinite(predicted[j])) known.push_back(j);
  }
  const std::vector<Eigen::Index> far = outliers(all.l(known), predicted(known), all.std_l(known));
  std::vector<Eigen::Index> kept;
  for (std::size_t k = 0; k < known.size(); ++k) {
    if (!std::binary_search(far.begin(), far.end(), static_cast<Eigen::Index>(k))) {
      kept.push_back(known[k]);
    }
  }
  if (kept.empty()) return;
  const DenseSystem system = selected(all, kept);
  LinearModel model;
  model.predicted = predicted(kept);
  model.jacobian.resize(system.l.size(), 2);
  model.jacobian.col(0) = system.weights * (e.scale.value * curve.d_u);
  model.jacobian.col(1) = system.weights * (e.scale.value * curve.d_q);
  model.scale_relative_std = scale_prior(scene).relative_std;
  fitted.departures = shot_departures(system, model);
  fitted.nuisances = system.nuisances;
  if (by_transport) {
    take_evidence(stated, result, system.nuisances, channel.shots, *fitted.departures);
  }
  std::vector<const SceneShot*> shots;
  for (const ObservedShot* shot : channel.shots) shots.push_back(shot->stated);
  fitted.causes = image_causes(stated, shots, system, model);
  fitted.edge_excess = edge_excess(channel.shots, of_dipole, kept, system, model);
}

// Whether transport explains the shots, though they may not determine its coefficients: what it
// leaves of them is then far less than what the dipole leaves.
bool shows_more_than_dipole(const ChannelResult& by_transport) {
  constexpr double kLess = 0.5;
  if (by_transport.rows.empty()) return false;
  return !by_transport.refused() ||
         by_transport.estimate.reduced_chi2 < kLess * by_transport.dipole->reduced_chi2;
}

// Whether the shots contradict a quantity of the rig: the dipole explains them with another value.
// Where it does not, the quantity is bent by the model's own error.
bool is_contradicted(const Estimate& e) {
  constexpr double kExplained = 3.0;
  return contradiction(e.pulls, kMostPull, kLeastPullImage) != nullptr &&
         e.reduced_chi2 < kExplained;
}

// The result of transport where the dipole does not hold, in the channel of its material with the
// most light; other such channels are not judged. Where something is known to be wrong with a shot
// already (its outline, exchanged lights, units), a quantity of the rig is contradicted, or
// transport does not explain the shots either, the dipole's departures say more than none.
std::vector<bool> judged_channels(Estimation& e,
                                  const std::vector<std::optional<DipoleSystem>>& systems,
                                  const std::vector<ObservedShot>& shots,
                                  const std::vector<Finding>& findings) {
  std::set<const ObservedShot*> explained;
  for (const Finding& f : findings) {
    for (const ObservedShot& shot : shots) {
      const std::size_t idx = e.scene.index_of(*shot.stated);
      if (std::find(f.shots.begin(), f.shots.end(), idx) != f.shots.end()) explained.insert(&shot);
    }
  }
  std::vector<bool> judged(e.channels.size(), false);
  std::map<std::string, std::size_t> best;
  for (std::size_t i = 0; i < e.channels.size(); ++i) {
    ChannelResult& result = e.results[i];
    if (!systems[i] || !result.estimate.converged) continue;
    result.why_transport = why_transport(result);
    judged[i] = result.why_transport.empty() || is_contradicted(result.estimate) ||
                std::any_of(e.channels[i].shots.begin(), e.channels[i].shots.end(),
                            [&](const ObservedShot* shot) { return explained.contains(shot); });
    if (judged[i]) continue;
    const auto [at, is_new] = best.try_emplace(e.channels[i].material, i);
    if (!is_new && result.image_in_std > e.results[at->second].image_in_std) at->second = i;
  }
  if (best.empty()) return judged;
  ProgressStage stage(e.progress, "transport", best.size());
  for (const auto& [material, i] : best) {
    ChannelResult result = start_from_dipole(e.results[i]);
    search_by_transport(e.scene, e.channels[i], *systems[i], *e.kept.atlas, true, e.options, stage,
                        result);
    judged[i] = true;
    if (shows_more_than_dipole(result)) e.results[i] = std::move(result);
    stage.step();
  }
  return judged;
}

std::vector<CheckedChannel> fitted_channels(const Scene& stated, Estimation& e,
                                            const std::vector<std::optional<DipoleSystem>>& systems,
                                            const std::vector<ObservedShot>& shots,
                                            const std::vector<Finding>& findings) {
  const std::vector<bool> judged = judged_channels(e, systems, shots, findings);
  std::vector<CheckedChannel> out;
  for (std::size_t i = 0; i < e.channels.size(); ++i) {
    CheckedChannel& fitted = out.emplace_back();
    fitted.material = e.channels[i].material;
    fitted.channel = e.channels[i].channel;
    fitted.model = e.results[i].model;
    for (const ObservedShot* shot : e.channels[i].shots) {
      fitted.shots.push_back(static_cast<std::size_t>(shot - shots.data()));
    }
    fitted.estimate = e.results[i].estimate;
    fitted.singles = e.results[i].singles;
    if (judged[i]) {
      add_departures(stated, e.scene, *systems[i], e.channels[i], e.results[i], fitted);
    }
  }
  return out;
}

// Adds to a doubtful shot's likeness what other objects would show.
void compare_objects(LightLook& look, const Estimation& e, const capture::ShotDecoding& decoding,
                     const capture::ShotSource& source, const SharedView& view, std::size_t i,
                     const ObservedShot& shot, ShotLikeness& likeness) {
  const auto* frames = std::get_if<capture::FrameSource>(&source.open);
  if (frames == nullptr) return;
  const std::vector<capture::RawFrame> exposures =
      capture::frames_of(*shot.stated, source.shot_idxs[i], *frames);
  const auto responsivity =
      e.scene.camera.responsivity.value_or(std::array<double, kRgb>{1.0, 1.0, 1.0});
  for (const auto& [name, seen] : view.objects) {
    if (name == shot.stated->object) continue;
    const SampleMap& map = seen->map;
    const capture::ShotSamples there =
        capture::shot_samples(e.scene, decoding, *shot.stated, exposures, source.names.at(i),
                              map.x0, map.y0, map.width, map.height);
    look.compare_object(*seen, observe(there.samples, map, responsivity),
                        LightLook::best_channel(shot.observation), likeness);
  }
}

}  // namespace

CheckFit fit_for_check(const Scene& stated, const Rig& rig, const capture::ShotSource& source,
                       SeenShots& seen, const std::vector<Finding>& looks, LitObjects& lit,
                       Progress* progress) {
  EstimateOptions options;
  options.keep_rows = true;
  options.time_limit_s = kTransport_s;
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  double motion_before = std::numeric_limits<double>::infinity();
  for (int views = 1;; ++views) {
    const std::vector<ObservedShot>& shots = seen.whole();
    KeptLight kept;
    Estimation e(rig.scene, lit, shots, useful_channels(rig, shots), options, kept, watch,
                 progress);
    std::vector<std::optional<DipoleSystem>> systems(e.channels.size());
    estimate_dipole(e, &systems);
    const SeenElsewhere elsewhere =
        seen_elsewhere(rig.scene, shots, joint_pulls_of(e.results).pulls, motion_before);
    if (views < kMostViews && elsewhere.motion > kVisibleMotion) {
      motion_before = elsewhere.motion;
      seen.open_from(elsewhere.shifts);
      continue;
    }
    CheckFit out;
    LightLook look(e.scene, lit, shots, kept.weights);
    for (std::size_t i = 0; i < shots.size(); ++i) {
      ShotLikeness& likeness = out.likeness.emplace_back(look.likeness(i));
      if (likeness.own > kDoubtfulImage && seen.view()) {
        compare_objects(look, e, rig.decoding, source, *seen.view(), i, shots[i], likeness);
      }
    }
    out.findings = look.findings();
    std::vector<Finding> known = looks;
    known.insert(known.end(), out.findings.begin(), out.findings.end());
    out.channels = fitted_channels(stated, e, systems, shots, known);
    return out;
  }
}

}  // namespace scattermeter::apps
