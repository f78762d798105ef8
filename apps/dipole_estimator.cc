// --model dipole: the dipole, with all that the rig knows only to a standard deviation.
#include <cmath>
#include <limits>
#include <map>

#include <oneapi/tbb/parallel_for.h>

#include "apps/estimation_task.h"
#include "apps/nuisances.h"
#include "apps/progress.h"
#include "core/dipole_curve.h"
#include "core/dipole_fit.h"

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
                           e.rig.light(light).environment ? e.tasks[i].channel : 0};
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
    all.by_light[key] = sensitivity(*seen, changed->second, list, knots);
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

}  // namespace

// Twice: without nuisances, to know the material that the image's dependence on them is computed
// for; then with them.
void estimate_dipole(Estimation& e) {
  const DistanceKnots knots(e.library.smallest_patch_mm() / 16.0, e.library.longest_distance_mm());
  const PairSumOptions pairs = pair_options(knots);
  const Weights& weights = e.weights;
  add_weights(
      e.shots, e.library, e.options.quiet,
      [&](const SeenObject& seen, const SourceCloud& sources) {
        return smooth_weights(seen.sites, sources, knots, pairs);
      },
      e.weights);
  e.watch.lap("light");
  DipoleFitOptions fit;
  fit.scale.relative_std = e.rig.camera.responsivity ? e.rig.camera.responsivity_relative_std
                                                     : std::numeric_limits<double>::infinity();
  std::vector<char> fitted(e.tasks.size(), 0);
  for_open_tasks("fitting", e, [&](std::size_t i) {
    DipoleFitOptions own = fit;
    own.eta_int_over_ext = e.tasks[i].eta;
    e.results[i].estimate = fit_dipole(system_of(e.rig, e.tasks[i], weights), knots, own).estimate;
    fitted[i] = e.results[i].estimate.converged ? 1 : 0;
  });
  e.watch.lap("first fit");
  const std::vector<bool> estimated(fitted.begin(), fitted.end());
  const Sensitivities all = sensitivities(e, estimated, knots);
  e.watch.lap("sensitivities");
  tbb::parallel_for(std::size_t{0}, e.tasks.size(), [&](std::size_t i) {
    if (!estimated[i]) return;
    DipoleFitOptions own = fit;
    own.eta_int_over_ext = e.tasks[i].eta;
    DenseSystem system = system_of(e.rig, e.tasks[i], weights);
    const Estimate& first = e.results[i].estimate;
    const double sigma_t = first.sigma_s_prime_per_mm.value + first.sigma_a_per_mm.value;
    const DipoleCurve curve = dipole_curve(knots, std::log(sigma_t),
                                           first.sigma_a_per_mm.value / sigma_t, e.tasks[i].eta);
    add_nuisances(e.rig, e.tasks[i].shots, e.tasks[i].channel, all.of_task[i], system);
    add_numerics(e.tasks[i].shots, e.tasks[i].channel, knots, first.scale.value * curve.r, system);
    e.results[i].estimate = fit_dipole(system, knots, own).estimate;
  });
  e.watch.lap("fit");
}

}  // namespace scattermeter::apps
