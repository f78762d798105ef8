// An estimation under way: what estimators work on.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/stopwatch.h"
#include "core/estimation/channel_result.h"
#include "core/estimation/channel_rows.h"
#include "core/estimation/channel_weights.h"
#include "core/estimation/estimate.h"
#include "core/estimation/material_channel.h"
#include "core/estimation/nuisances.h"
#include "core/fit/dipole_fit.h"

namespace scattermeter {

// What serves the next set of shots of the same views as well.
struct KeptLight {
  Weights weights;  // on smooth knots
  ChangedWeightsByLight changed;
};

class Estimation {
 public:
  // Makes a result for each material and channel, refused where a shot is of no use as a whole.
  // wanted: of these shots. Everything that is referred to must outlive it.
  Estimation(const Scene& of_scene, LitObjects& lit_objects, std::span<const ObservedShot> observed,
             std::vector<MaterialChannel> wanted, const EstimateOptions& estimate_options,
             KeptLight& kept_light, Stopwatch& stopwatch, Progress* reported_to);

  const Scene& scene;
  LitObjects& lit;
  const std::span<const ObservedShot> shots;
  const EstimateOptions& options;
  KeptLight& kept;
  Stopwatch& watch;
  Progress* const progress;
  const std::vector<MaterialChannel> channels;
  std::vector<ChannelResult> results;  // one per channel; those refused already are left alone

  // Runs `work` on every channel whose result is not refused yet, in parallel, as one stage.
  void for_open_channels(const std::string& stage,
                         const std::function<void(std::size_t)>& work) const;
};

// How well the scene knows the scale: free without a responsivity.
ScalePrior scale_prior(const Scene& scene);

// What the dipole is fitted to, before it calls rows outliers.
struct DipoleSystem {
  // Of all shots; made when asked for, since it is large. As long as the estimation is there.
  std::function<DenseSystem()> system;
  DistanceKnots knots;
  std::shared_ptr<const ChannelRows> rows;
  double image_in_std = 0;  // |l / std|
};

// The estimators fill the results' estimates. systems: if given, those of the channels that came to
// a fit.
void estimate_dipole(Estimation& e, std::vector<std::optional<DipoleSystem>>* systems);
void estimate_dipole(Estimation& e);
void estimate_auto(Estimation& e);
void estimate_transport(Estimation& e);
void estimate_paper(Estimation& e);

}  // namespace scattermeter
