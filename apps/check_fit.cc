#include "apps/check_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <utility>

#include "apps/estimation_task.h"
#include "apps/stopwatch.h"
#include "core/dipole_curve.h"
#include "core/row_selection.h"

namespace scattermeter::apps {
namespace {

// What an image may look like while its material is not known, per mm.
constexpr std::array<std::pair<double, double>, 3> kMedia = {
    {{0.4, 0.003}, {1.0, 0.003}, {3.0, 0.003}}};

// A shot explained worse than this as it is listed may be of something else.
constexpr double kDoubtful = 0.1;

std::vector<Task> useful_tasks(const Rig& rig, const std::vector<OpenedShot>& shots) {
  std::vector<Task> tasks;
  for (Task& task : tasks_of(rig, shots)) {
    std::erase_if(task.shots,
                  [&](const OpenedShot* s) { return !shot_problem(*s, task.channel).empty(); });
    if (!task.shots.empty()) tasks.push_back(std::move(task));
  }
  return tasks;
}

// The joint model at its optimum, and what each shot does beside it.
void add_departures(const Rig& rig, const DipoleSystem& fitted, double eta, CheckedTask& task) {
  const Estimate& e = task.estimate;
  const double sigma_t = e.sigma_s_prime_per_mm.value + e.sigma_a_per_mm.value;
  const DipoleCurve curve =
      dipole_curve(fitted.knots, std::log(sigma_t), e.sigma_a_per_mm.value / sigma_t, eta);
  const auto model_of = [&](const DenseSystem& system) {
    calib::LinearModel model;
    model.predicted = system.weights * (e.scale.value * curve.r);
    model.jacobian.resize(system.l.size(), 2);
    model.jacobian.col(0) = system.weights * (e.scale.value * curve.d_u);
    model.jacobian.col(1) = system.weights * (e.scale.value * curve.d_q);
    model.scale_relative_std = scale_prior(rig).relative_std;
    return model;
  };
  const DenseSystem all = fitted.system();
  const std::vector<Eigen::Index> far = outliers(all.l, model_of(all).predicted, all.std_l);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index j = 0; j < all.l.size(); ++j) {
    if (!std::binary_search(far.begin(), far.end(), j)) kept.push_back(j);
  }
  const DenseSystem system = selected(all, kept);
  task.departures = calib::shot_departures(system, model_of(system));
  task.nuisances = system.nuisances;
}

std::vector<CheckedTask> fit_tasks(Estimation& e, const std::vector<OpenedShot>& shots) {
  std::vector<std::optional<DipoleSystem>> systems(e.tasks.size());
  estimate_dipole(e, &systems);
  std::vector<CheckedTask> out;
  for (std::size_t i = 0; i < e.tasks.size(); ++i) {
    CheckedTask& task = out.emplace_back();
    task.material = e.tasks[i].material;
    task.channel = e.tasks[i].channel;
    for (const OpenedShot* shot : e.tasks[i].shots) {
      task.shots.push_back(static_cast<std::size_t>(shot - shots.data()));
    }
    task.estimate = e.results[i].estimate;
    task.singles = e.results[i].singles;
    if (task.estimate.converged && systems[i]) {
      add_departures(e.rig, *systems[i], e.tasks[i].eta, task);
    }
  }
  return out;
}

// A shot's image in its best channel against lights that it may have been lit by.
class Likeness {
 public:
  Likeness(Estimation& e, const std::vector<OpenedShot>& shots, const ShotSource& source,
           const std::optional<SharedView>& shared)
      : e_(e), shots_(shots), source_(source), shared_(shared), knots_(smooth_knots(e.library)) {
    for (const auto& [s, a] : kMedia) {
      curves_.push_back(dipole_curve(knots_, std::log(s + a), a / (s + a), 1.4).r);
    }
    for (const RigShot& shot : e.rig.shots) {
      std::vector<std::string> lights = shot.lights;
      std::sort(lights.begin(), lights.end());
      if (std::find(settings_.begin(), settings_.end(), lights) == settings_.end()) {
        settings_.push_back(lights);
      }
    }
    add_missing_weights();
  }

  ShotLikeness of(std::size_t i) {
    const OpenedShot& shot = shots_[i];
    const std::size_t c = best_channel(shot.observation);
    ShotLikeness out;
    if (!shot_problem(shot, c).empty()) return out;
    std::vector<std::string> own = shot.rig->lights;
    std::sort(own.begin(), own.end());
    out.own = misfit(*shot.seen, shot.observation.channel[c], own, c);
    for (const auto& lights : settings_) {
      if (lights == own) continue;
      offer(misfit(*shot.seen, shot.observation.channel[c], lights, c), "lit by " + joined(lights),
            out);
    }
    if (!(out.own > kDoubtful) || !shared_) return out;
    if (const FrameSource* frames = std::get_if<FrameSource>(&source_.open)) {
      const std::vector<capture::RawFrame> exposures =
          frames_of(*shot.rig, source_.shot_idxs[i], *frames);
      for (const auto& [name, seen] : shared_->objects) {
        if (name == shot.rig->object) continue;
        const Observation seen_there = observe_as(i, exposures, *seen);
        for (const auto& lights : settings_) {
          offer(misfit(*seen, seen_there.channel[c], lights, c),
                "of object " + name + ", lit by " + joined(lights), out);
        }
      }
    }
    return out;
  }

 private:
  static std::string joined(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : " and ") + name;
    return out;
  }

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

  // Every view under every light.
  void add_missing_weights() {
    std::deque<RigShot> rig_shots;
    std::vector<OpenedShot> stubs;
    std::vector<std::string> lights;
    for (const auto& setting : settings_)
      lights.insert(lights.end(), setting.begin(), setting.end());
    for (const OpenedShot& shot : shots_) {
      RigShot& all = rig_shots.emplace_back(*shot.rig);
      all.lights = lights;
      OpenedShot& stub = stubs.emplace_back();
      stub.rig = &all;
      stub.seen = shot.seen;
    }
    add_smooth_weights(stubs, e_.library, true, e_.weights);
  }

  Observation observe_as(std::size_t i, const std::vector<capture::RawFrame>& exposures,
                         const SeenObject& seen) const {
    const SampleMap& map = seen.map;
    return observe(shot_samples(e_.rig, *shots_[i].rig, exposures, source_.names.at(i), map.x0,
                                map.y0, map.width, map.height)
                       .samples,
                   map, e_.rig.camera.responsivity.value_or(std::array<double, 3>{1.0, 1.0, 1.0}));
  }

  // rms of l less the best multiple of a medium's image, over rms l; NaN without 20 rows.
  double misfit(const SeenObject& seen, const ChannelObservation& o,
                const std::vector<std::string>& lights, std::size_t c) const {
    double best = std::numeric_limits<double>::quiet_NaN();
    if (o.rows_used < 20) return best;
    for (const Eigen::VectorXd& r : curves_) {
      Eigen::VectorXd image = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(o.l.size()));
      for (const std::string& name : lights) {
        const RigLight& light = e_.rig.light(name);
        image += light.power()[static_cast<Eigen::Index>(c)] *
                 (e_.weights.at({&seen, name, light.colours_differ() ? c : 0}) * r);
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
  const std::vector<OpenedShot>& shots_;
  const ShotSource& source_;
  const std::optional<SharedView>& shared_;
  DistanceKnots knots_;
  std::vector<Eigen::VectorXd> curves_;
  std::vector<std::vector<std::string>> settings_;  // of lights, sorted
};

}  // namespace

CheckFit fit_for_check(const Rig& rig, const ShotSource& source,
                       const std::vector<OpenedShot>& shots, ObjectLibrary& library,
                       const std::optional<SharedView>& shared, bool quiet) {
  const std::vector<Task> tasks = useful_tasks(rig, shots);
  MeasureOptions options;
  options.quiet = quiet;
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  Weights weights;
  ChangedWeightsByLight changed_weights;
  std::vector<ChannelResult> results(tasks.size());
  Estimation e{rig, shots, tasks, library, weights, changed_weights, options, watch, results};
  CheckFit out;
  out.tasks = fit_tasks(e, shots);
  Likeness likeness(e, shots, source, shared);
  for (std::size_t i = 0; i < shots.size(); ++i) out.likeness.push_back(likeness.of(i));
  return out;
}

}  // namespace scattermeter::apps
