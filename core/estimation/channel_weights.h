// The weights W of every view of an object under every light of some shots.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <tuple>

#include "core/base/progress.h"
#include "core/diffusion/distance_weights.h"
#include "core/diffusion/weight_store.h"
#include "core/scene/observed_shot.h"

namespace scattermeter {

// By (view of an object, light, channel of the light).
using WeightKey = std::tuple<const SeenObject*, std::string, std::size_t>;
using Weights = std::map<WeightKey, WeightMatrix>;

// Computes W of every view and light that a shot needs, each once, in parallel; existing ones are
// kept. Of the shots only `stated` and `seen` are used. Throws as LitObjects::light(), or
// Cancelled; weights are as before then.
void add_weights(const Scene& scene, std::span<const ObservedShot> shots, LitObjects& lit,
                 Progress* progress,
                 const std::function<WeightMatrix(const SeenObject&, const SourceCloud&)>& make,
                 Weights& weights);

// Knots for these objects: as fine as their patches allow.
DistanceKnots smooth_knots(const LitObjects& lit);
// Near-field options for these knots.
PairSumOptions pair_options(const DistanceKnots& knots);
// add_weights() on smooth knots. store: may be null.
void add_smooth_weights(const Scene& scene, std::span<const ObservedShot> shots, LitObjects& lit,
                        Progress* progress, Weights& weights, WeightStore* store = nullptr);

}  // namespace scattermeter
