// --model dipole: the dipole, with all that the rig knows only to a standard deviation.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <oneapi/tbb/parallel_for.h>

#include "apps/dipole_system.h"
#include "apps/estimation_task.h"
#include "apps/nuisances.h"
#include "apps/progress.h"
#include "core/dipole_fit.h"
#include "core/dipole_misfit.h"
#include "core/image_information.h"
#include "core/row_selection.h"
#include "core/shot_agreement.h"
#include "core/smooth_reflectance.h"

namespace scattermeter::apps {
namespace {

// Sensitivities of every view and light, each for all the tasks that have a first estimate there.
struct Sensitivities {
  std::map<LightKey, LightSensitivity> by_light;
  std::vector<std::map<LightKey, TaskSensitivity>> of_task;
};

Sensitivities sensitivities(const Estimation& e, const std::vector<bool>& estimated,
                            const DistanceKnots& knots) {
  std::map<LightKey, std::vector<LitMedium>> media;
  std::vector<std::map<LightKey, Eigen::Index>> column(e.tasks.size());
  for (std::size_t i = 0; i < e.tasks.size(); ++i) {
    if (!estimated[i]) continue;
    const Estimate& first = e.results[i].estimate;
    for (const OpenedShot* shot : e.tasks[i].shots) {
      for (const std::string& light : shot->rig->lights) {
        const LightKey key{shot->seen.get(), light,
                           e.rig.light(light).colours_differ() ? e.tasks[i].channel : 0};
        const auto [it, is_new] =
            column[i].try_emplace(key, static_cast<Eigen::Index>(media[key].size()));
        if (is_new) {
          media[key].push_back({{first.sigma_s_prime_per_mm.value, first.sigma_a_per_mm.value, 1.0},
                                first.scale.value});
        }
      }
    }
  }
  Sensitivities all;
  Progress progress("uncertainties", static_cast<int>(media.size()), e.options.quiet);
  for (const auto& [key, list] : media) {
    const auto& [seen, light, channel] = key;
    const auto [changed, is_new] = e.changed_weights.try_emplace(key);
    if (is_new) {
      changed->second = changed_weights(*seen, e.rig.light(light), channel, e.library, knots);
    }
    all.by_light[key] = sensitivity(*seen, e.weights.at(key), changed->second, list, knots);
    progress.step();
  }
  all.of_task.resize(e.tasks.size());
  for (std::size_t i = 0; i < e.tasks.size(); ++i) {
    for (const auto& [key, medium] : column[i]) {
      all.of_task[i][key] = {&all.by_light.at(key), medium};
    }
  }
  return all;
}

// One material and channel on its way to an estimate.
struct Work {
  TaskRows rows;
  bool estimated = false;  // a first estimate is there
  bool settled = false;    // another round would not change it
};

bool settled(const Estimate& before, const Estimate& after) {
  constexpr double kOfStd = 0.02;
  const auto close = [](const Quantity& a, const Quantity& b) {
    return std::abs(a.value - b.value) <= kOfStd * b.std;
  };
  return close(before.sigma_s_prime_per_mm, after.sigma_s_prime_per_mm) &&
         close(before.sigma_a_per_mm, after.sigma_a_per_mm);
}

class DipoleEstimator {
 public:
  DipoleEstimator(Estimation& e, std::vector<std::optional<DipoleSystem>>* systems)
      : e_(e),
        systems_(systems),
        knots_(e.library.smallest_patch_mm() / 16.0, e.library.longest_distance_mm()),
        work_(e.tasks.size()) {
    fit_.scale = scale_prior(e.rig);
    fit_.without_noise = e.without_noise;
  }

  // Without nuisances, to know the material that rows are weighed for and that the image's
  // dependence on the nuisances is computed for; then with them, and once more where that shows
  // rows that are outliers.
  void run() {
    const PairSumOptions pairs = pair_options(knots_);
    add_weights(
        e_.shots, e_.library, e_.options.quiet,
        [&](const SeenObject& seen, const SourceCloud& sources) {
          return smooth_weights(seen.sites, sources, knots_, pairs);
        },
        e_.weights);
    e_.watch.lap("light");
    for_open_tasks("fitting", e_, [&](std::size_t i) { first_fit(i); });
    e_.watch.lap("first fit");
    std::vector<bool> open;
    for (const Work& w : work_) open.push_back(w.estimated);
    // What ambient light adds depends on the material itself: those tasks go round again until they
    // settle (an error falls to a sixth each time).
    constexpr int kRounds = 8;
    for (int round = 0; round < kRounds; ++round) {
      sensitivities_ = sensitivities(e_, open, knots_);
      e_.watch.lap("sensitivities");
      tbb::parallel_for(std::size_t{0}, e_.tasks.size(), [&](std::size_t i) {
        if (!open[i]) return;
        const Estimate before = e_.results[i].estimate;
        final_fit(i);
        work_[i].settled = !has_ambient(e_.tasks[i]) || settled(before, e_.results[i].estimate);
      });
      e_.watch.lap("fit");
      bool again = false;
      for (std::size_t i = 0; i < open.size(); ++i) {
        open[i] = open[i] && !work_[i].settled && e_.results[i].estimate.converged;
        again = again || open[i];
      }
      if (!again) break;
    }
  }

 private:
  DipoleFitOptions options_of(const Task& task) const {
    DipoleFitOptions own = fit_;
    own.eta_int_over_ext = task.eta;
    return own;
  }

  void first_fit(std::size_t i) {
    Work& work = work_[i];
    const Task& task = e_.tasks[i];
    work.rows = rows_of(e_.rig, task);
    DenseSystem system = system_of(e_.rig, task, work.rows, e_.weights, 0.0);
    add_offsets(task, system);
    DipoleFit fit = fit_to_some(system, options_of(task));
    e_.results[i].estimate = fit.estimate;
    report_rows(task, work.rows, e_.results[i]);
    work.estimated = fit.estimate.converged;
    if (!work.estimated) return;
    Eigen::Index at = 0;
    for (ChannelObservation& o : work.rows) {
      const auto n = static_cast<Eigen::Index>(o.rows_used);
      expect(o, fit.predicted.segment(at, n));
      at += n;
    }
  }

  // To some thousand rows evenly among all, which tell a material well enough to begin with; where
  // they don't, to all of them.
  DipoleFit fit_to_some(const DenseSystem& system, const DipoleFitOptions& options) const {
    constexpr Eigen::Index kRows = 4096;
    const Eigen::Index step = system.l.size() / kRows;
    if (step > 1) {
      std::vector<Eigen::Index> rows;
      for (Eigen::Index j = 0; j < system.l.size(); j += step) rows.push_back(j);
      DipoleFit fit = fit_dipole(selected(system, rows), knots_, options);
      if (fit.estimate.converged) {
        fit.predicted = predicted_image(system, knots_, fit.optimum, options.eta_int_over_ext);
        return fit;
      }
    }
    return fit_dipole(system, knots_, options);
  }

  bool has_ambient(const Task& task) const {
    for (const OpenedShot* shot : task.shots) {
      for (const std::string& name : shot->rig->lights) {
        if (e_.rig.light(name).is_ambient) return true;
      }
    }
    return false;
  }

  // While the material is not known, ambient light stands as a free constant in the shots that it
  // falls into: on a body without hollows it is nearly that.
  void add_offsets(const Task& task, DenseSystem& system) const {
    Eigen::VectorXd offset = Eigen::VectorXd::Zero(system.l.size());
    Eigen::Index at = 0;
    for (std::size_t s = 0; s < task.shots.size(); ++s) {
      const Eigen::Index rows = system.shot_rows[s];
      for (const std::string& name : task.shots[s]->rig->lights) {
        const RigLight& light = e_.rig.light(name);
        if (light.ambient_std_W_per_mm2_sr[static_cast<Eigen::Index>(task.channel)] > 0.0) {
          offset.segment(at, rows).setConstant(system.l.mean());
        }
      }
      at += rows;
    }
    if (offset.isZero(0.0)) return;
    system.nuisances.push_back({"ambient", std::numeric_limits<double>::infinity(), true});
    system.nuisance_columns = offset;
  }

  // The system with all that the rig knows only to a standard deviation, and with the errors of the
  // method.
  DenseSystem full_system(std::size_t i, const Estimate& first) const {
    return dipole_system(
        e_.rig, e_.tasks[i], work_[i].rows, e_.weights, knots_,
        {{first.sigma_s_prime_per_mm.value, first.sigma_a_per_mm.value, 1.0}, first.scale.value},
        sensitivities_.of_task[i]);
  }

  bool leave_outliers_out(const DenseSystem& system, const DipoleFit& fit, TaskRows& rows) const {
    if (fit.predicted.size() == 0) return false;
    const std::vector<Eigen::Index> far = outliers(system.l, fit.predicted, system.std_l);
    auto next = far.begin();
    Eigen::Index at = 0;
    for (ChannelObservation& o : rows) {
      for (std::size_t j = 0; j < o.l.size(); ++j) {
        if (o.state[j] != RowState::kUsed) continue;
        if (next != far.end() && *next == at) {
          leave_out(o, j, RowState::kOutlier);
          ++next;
        }
        ++at;
      }
    }
    return !far.empty();
  }

  void final_fit(std::size_t i) {
    const Task& task = e_.tasks[i];
    ChannelResult& result = e_.results[i];
    const Estimate first = result.estimate;
    const DipoleFitOptions options = options_of(task);
    DenseSystem system = full_system(i, first);
    if (systems_ != nullptr) (*systems_)[i] = DipoleSystem{system, knots_, work_[i].rows};
    std::vector<ImageInformation> images;
    const auto fitted = [&] {
      images = information_by_shot(system);
      ImageInformation all = images.at(0);
      for (std::size_t s = 1; s < images.size(); ++s) all += images[s];
      return fit_dipole(system, all, knots_, options);
    };
    DipoleFit fit = fitted();
    if (leave_outliers_out(system, fit, work_[i].rows)) {
      system = full_system(i, first);
      fit = fitted();
    }
    report_rows(task, work_[i].rows, result);
    result.estimate = fit.estimate;
    if (!fit.estimate.converged) return;
    if (e_.options.keep_rows) {
      result.rows = shot_rows(task, work_[i].rows, fit.predicted, system.std_l);
    }
    SmoothReflectanceOptions smooth;
    smooth.scale = options.scale;
    result.recovered = smooth_reflectance(fit.recovered, system.nuisances, knots_, smooth);
    DipoleMisfitOptions misfit;
    misfit.scale = options.scale;
    result.misfit =
        dipole_misfit(fit.recovered, system.nuisances, knots_,
                      {fit.optimum.sigma_s_prime_per_mm(), fit.optimum.sigma_a_per_mm(), task.eta},
                      std::exp(fit.optimum.log_s), misfit);
    if (task.shots.size() < 2) return;
    result.singles.clear();
    for (std::size_t s = 0; s < task.shots.size(); ++s) {
      const ImageInformation own =
          with_nuisances(images[s], knots_.size(), nuisances_of_shot(system, s));
      result.singles.push_back({task.shots[s]->rig->file,
                                fit_dipole(shot_of(system, s), own, knots_, options).estimate});
    }
    result.agreement = shot_agreement(system, knots_, fit.optimum, task.eta, options.scale,
                                      std::max(1.0, fit.estimate.reduced_chi2));
    widen_by_disagreement(result.agreement, result.estimate);
  }

  Estimation& e_;
  std::vector<std::optional<DipoleSystem>>* systems_;
  DistanceKnots knots_;
  DipoleFitOptions fit_;
  std::vector<Work> work_;
  Sensitivities sensitivities_;
};

}  // namespace

void estimate_dipole(Estimation& e, std::vector<std::optional<DipoleSystem>>* systems) {
  DipoleEstimator(e, systems).run();
}

}  // namespace scattermeter::apps
