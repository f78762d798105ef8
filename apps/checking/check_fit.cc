#include "apps/checking/check_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <utility>

#include <fmt/format.h>

#include "capture/shots/shot_samples.h"
#include "core/base/progress.h"
#include "core/base/stopwatch.h"
#include "core/diffusion/dipole_curve.h"
#include "core/estimation/estimation.h"
#include "core/view/row_selection.h"

namespace scattermeter::apps {
namespace {

// Media (sigma_s', sigma_a; 1/mm) that stand in for a material not yet known.
constexpr std::array<std::pair<double, double>, 3> kMedia = {
    {{0.4, 0.003}, {1.0, 0.003}, {3.0, 0.003}}};

// A shot whose listed object and lights leave a larger relative misfit may show something else.
constexpr double kDoubtful = 0.1;

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

// Adds the departures of each shot from the joint model at its optimum.
void add_departures(const Scene& scene, const DipoleSystem& of_dipole, double eta,
                    CheckedChannel& fitted) {
  const Estimate& e = fitted.estimate;
  const double sigma_t = e.sigma_s_prime_per_mm.value + e.sigma_a_per_mm.value;
  const DipoleCurve curve =
      dipole_curve(of_dipole.knots, std::log(sigma_t), e.sigma_a_per_mm.value / sigma_t, eta);
  const auto model_of = [&](const DenseSystem& system) {
    LinearModel model;
    model.predicted = system.weights * (e.scale.value * curve.r);
    model.jacobian.resize(system.l.size(), 2);
    model.jacobian.col(0) = system.weights * (e.scale.value * curve.d_u);
    model.jacobian.col(1) = system.weights * (e.scale.value * curve.d_q);
    model.scale_relative_std = scale_prior(scene).relative_std;
    return model;
  };
  const DenseSystem all = of_dipole.system();
  const std::vector<Eigen::Index> far = outliers(all.l, model_of(all).predicted, all.std_l);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < all.l.size(); ++j) {
    if (!std::binary_search(far.begin(), far.end(), j)) kept.push_back(j);
  }
  const DenseSystem system = selected(all, kept);
  fitted.departures = shot_departures(system, model_of(system));
  fitted.nuisances = system.nuisances;
}

std::vector<CheckedChannel> fitted_channels(Estimation& e, const std::vector<ObservedShot>& shots) {
  std::vector<std::optional<DipoleSystem>> systems(e.channels.size());
  estimate_dipole(e, &systems);
  std::vector<CheckedChannel> out;
  for (std::size_t i = 0; i < e.channels.size(); ++i) {
    CheckedChannel& fitted = out.emplace_back();
    fitted.material = e.channels[i].material;
    fitted.channel = e.channels[i].channel;
    for (const ObservedShot* shot : e.channels[i].shots) {
      fitted.shots.push_back(static_cast<std::size_t>(shot - shots.data()));
    }
    fitted.estimate = e.results[i].estimate;
    fitted.singles = e.results[i].singles;
    if (fitted.estimate.converged && systems[i]) {
      add_departures(e.scene, *systems[i], e.channels[i].eta_int_over_ext, fitted);
    }
  }
  return out;
}

// Compares a shot's image in its best channel with what other lights or objects would show.
class Likeness {
 public:
  Likeness(Estimation& e, const capture::ShotDecoding& decoding,
           const std::vector<ObservedShot>& shots, const capture::ShotSource& source,
           const std::optional<SharedView>& shared)
      : e_(e),
        decoding_(decoding),
        shots_(shots),
        source_(source),
        shared_(shared),
        knots_(smooth_knots(e.lit)) {
    for (const auto& [s, a] : kMedia) {
      curves_.push_back(dipole_curve(knots_, std::log(s + a), a / (s + a), 1.4).r);
    }
    for (const SceneShot& shot : e.scene.shots) {
      std::vector<std::string> lights = shot.lights;
      std::sort(lights.begin(), lights.end());
      if (std::find(settings_.begin(), settings_.end(), lights) == settings_.end()) {
        settings_.push_back(lights);
      }
    }
    add_missing_weights();
  }

  ShotLikeness of(std::size_t i) {
    const ObservedShot& shot = shots_[i];
    const std::size_t c = best_channel(shot.observation);
    ShotLikeness out;
    if (!shot_problem(shot, c).empty()) return out;
    std::vector<std::string> own = shot.stated->lights;
    std::sort(own.begin(), own.end());
    out.own = misfit(*shot.seen, shot.observation.channel[c], own, c);
    for (const auto& lights : settings_) {
      if (lights == own) continue;
      offer(misfit(*shot.seen, shot.observation.channel[c], lights, c),
            fmt::format("lit by {}", fmt::join(lights, " and ")), out);
    }
    if (!(out.own > kDoubtful) || !shared_) return out;
    if (const capture::FrameSource* frames = std::get_if<capture::FrameSource>(&source_.open)) {
      const std::vector<capture::RawFrame> exposures =
          capture::frames_of(*shot.stated, source_.shot_idxs[i], *frames);
      for (const auto& [name, seen] : shared_->objects) {
        if (name == shot.stated->object) continue;
        const Observation seen_there = observe_as(i, exposures, *seen);
        for (const auto& lights : settings_) {
          offer(misfit(*seen, seen_there.channel[c], lights, c),
                fmt::format("of object {}, lit by {}", name, fmt::join(lights, " and ")), out);
        }
      }
    }
    return out;
  }

 private:
  static std::size_t best_channel(const Observation& o) {
    std::size_t best = 0;
    for (std::size_t c = 1; c < kRgb; ++c) {
      if (o.channel[c].rows_used > o.channel[best].rows_used) best = c;
    }
    return best;
  }

  static void offer(double misfit, const std::string& what, ShotLikeness& out) {
    if (!(misfit < out.best_other)) return;
    out.best_other = misfit;
    out.other = what;
  }

  // Adds the weights of every view under every light.
  void add_missing_weights() {
    std::deque<SceneShot> stated;
    std::vector<ObservedShot> stubs;
    std::vector<std::string> lights;
    for (const auto& setting : settings_)
      lights.insert(lights.end(), setting.begin(), setting.end());
    for (const ObservedShot& shot : shots_) {
      SceneShot& all = stated.emplace_back(*shot.stated);
      all.lights = lights;
      ObservedShot& stub = stubs.emplace_back();
      stub.stated = &all;
      stub.seen = shot.seen;
    }
    add_smooth_weights(e_.scene, stubs, e_.lit, nullptr, e_.kept.weights);
  }

  Observation observe_as(std::size_t i, const std::vector<capture::RawFrame>& exposures,
                         const SeenObject& seen) const {
    const SampleMap& map = seen.map;
    return observe(capture::shot_samples(e_.scene, decoding_, *shots_[i].stated, exposures,
                                         source_.names.at(i), map.x0, map.y0, map.width, map.height)
                       .samples,
                   map,
                   e_.scene.camera.responsivity.value_or(std::array<double, 3>{1.0, 1.0, 1.0}));
  }

  // rms of l minus the best multiple of a medium's image, over the rms of l; NaN for less than 20
  // rows.
  double misfit(const SeenObject& seen, const ChannelObservation& o,
                const std::vector<std::string>& lights, std::size_t c) const {
    double best = std::numeric_limits<double>::quiet_NaN();
    if (o.rows_used < 20) return best;
    for (const Eigen::VectorXd& r : curves_) {
      Eigen::VectorXd image = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(o.l.size()));
      for (const std::string& name : lights) {
        const SceneLight& light = e_.scene.light(name);
        image += light->power()[static_cast<Eigen::Index>(c)] *
                 (e_.kept.weights.at({&seen, name, light.channel_of(c)}) * r);
      }
      double ll = 0.0;
      double lm = 0.0;
      double mm = 0.0;
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        if (o.state[j] != RowState::kUsed) continue;
        const double m = image[static_cast<Eigen::Index>(j)];
        ll += o.l[j] * o.l[j];
        lm += o.l[j] * m;
        mm += m * m;
      }
      const double rest = std::sqrt(std::max(0.0, 1.0 - lm * lm / (ll * mm)));
      if (!(best <= rest)) best = rest;
    }
    return best;
  }

  Estimation& e_;
  const capture::ShotDecoding& decoding_;
  const std::vector<ObservedShot>& shots_;
  const capture::ShotSource& source_;
  const std::optional<SharedView>& shared_;
  DistanceKnots knots_;
  std::vector<Eigen::VectorXd> curves_;
  std::vector<std::vector<std::string>> settings_;  // of lights, sorted
};

}  // namespace

CheckFit fit_for_check(const Rig& rig, const capture::ShotSource& source,
                       const std::vector<ObservedShot>& shots, LitObjects& lit,
                       const std::optional<SharedView>& shared, Progress* progress) {
  const EstimateOptions options;
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  KeptLight kept;
  Estimation e(rig.scene, lit, shots, useful_channels(rig, shots), options, kept, watch, progress);
  CheckFit out;
  out.channels = fitted_channels(e, shots);
  Likeness likeness(e, rig.decoding, shots, source, shared);
  for (std::size_t i = 0; i < shots.size(); ++i) out.likeness.push_back(likeness.of(i));
  return out;
}

}  // namespace scattermeter::apps
