#include "core/estimation/channel_weights.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "core/base/progress.h"

namespace scattermeter {

void add_weights(const Scene& scene, std::span<const ObservedShot> shots, LitObjects& lit,
                 Progress* progress,
                 const std::function<WeightMatrix(const SeenObject&, const SourceCloud&)>& make,
                 Weights& weights) {
  std::vector<WeightKey> keys;
  for (const ObservedShot& shot : shots) {
    for (const std::string& light : shot.stated->lights) {
      for (std::size_t c = 0; c < scene.light(light)->channels(); ++c) {
        const WeightKey key{shot.seen.get(), light, c};
        const bool is_new =
            !weights.contains(key) && std::find(keys.begin(), keys.end(), key) == keys.end();
        if (is_new) keys.push_back(key);
      }
    }
  }
  std::vector<const IncidentLight*> lights;
  for (const WeightKey& key : keys) {
    const auto& [view, name, channel] = key;
    lights.push_back(&lit.light(view->object->stated->name, name, channel));
  }
  std::vector<WeightMatrix> made(keys.size());
  ProgressStage stage(progress, "light in each patch", keys.size());
  tbb::parallel_for(std::size_t{0}, keys.size(), [&](std::size_t k) {
    const SeenObject& seen = *std::get<0>(keys[k]);
    made[k] = make(seen, SourceCloud(*lights[k], seen.object->box.center_mm()));
    stage.step();
  });
  for (std::size_t k = 0; k < keys.size(); ++k) weights.emplace(keys[k], std::move(made[k]));
}

DistanceKnots smooth_knots(const LitObjects& lit) {
  return {lit.smallest_patch_mm() / 16.0, lit.longest_distance_mm()};
}

PairSumOptions pair_options(const DistanceKnots& knots) {
  PairSumOptions options;
  // The shortest mean free path that fit_dipole() accepts is five resolutions; a fifth of that
  // keeps the near integral below 1e-5.
  options.floor_mm = knots.resolution_mm();
  return options;
}

void add_smooth_weights(const Scene& scene, std::span<const ObservedShot> shots, LitObjects& lit,
                        Progress* progress, Weights& weights, WeightStore* store) {
  const DistanceKnots knots = smooth_knots(lit);
  const PairSumOptions pairs = pair_options(knots);
  add_weights(
      scene, shots, lit, progress,
      [&](const SeenObject& seen, const SourceCloud& sources) {
        return smooth_weights(seen.sites, sources, knots, pairs, store);
      },
      weights);
}

}  // namespace scattermeter
