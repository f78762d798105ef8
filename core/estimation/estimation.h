// The state of an estimation in progress, shared by the estimators.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/atlas/transport_atlas.h"
#include "core/base/progress.h"
#include "core/base/stopwatch.h"
#include "core/estimation/channel_result.h"
#include "core/estimation/channel_rows.h"
#include "core/estimation/channel_weights.h"
#include "core/estimation/estimate.h"
#include "core/estimation/material_channel.h"
#include "core/fit/dipole_fit.h"
#include "core/nuisances/nuisances.h"

namespace scattermeter {

// A view with fewer rows, and which of the whole view's they are.
struct ThinnedView {
  RowChoice choice;
  std::shared_ptr<const SeenObject> seen;
};

// Light that can be reused for further shots of the same views.
struct KeptLight {
  Weights weights;  // on smooth knots
  ChangedWeightsByLight changed;
  // Of all views.
  std::shared_ptr<TransportAtlas> atlas = std::make_shared<TransportAtlas>();
  // Of W between programs; null: not kept.
  std::shared_ptr<WeightStore> store = {};
  // By the whole view, and the levels of the choice (spread_rows()).
  std::map<std::pair<const SeenObject*, int>, ThinnedView> thinned = {};
};

class Estimation {
 public:
  // Creates a result for each material and channel, refused if one of its shots is useless as a
  // whole. wanted: material channels of these shots. All arguments must outlive it.
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
  std::vector<ChannelResult> results;  // one per channel; refused ones are left unchanged

  // Runs `work` for every channel whose result is not yet refused, in parallel, as one stage.
  void for_open_channels(const std::string& stage,
                         const std::function<void(std::size_t)>& work) const;
  // For models that know smooth surfaces only: refuses the channels with rough ones.
  void refuse_rough_surfaces();
};

// The scene's prior of the scale: free without a responsivity.
ScalePrior scale_prior(const Scene& scene);

// The system to which the dipole is fitted, before the rejection of outliers.
struct DipoleSystem {
  // Of all shots; computed on each call, since it is large. Valid as long as the estimation exists.
  std::function<DenseSystem()> system;
  DistanceKnots knots;
  std::shared_ptr<const ChannelRows> rows;
  // Of its rows: light by way of the plane below the objects, which the system's l is without
  // because W r is. May be empty: there is none.
  std::function<Eigen::VectorXd()> light_by_plane = {};
};

// The estimators fill in the results' estimates. systems: if given, receives those of the channels
// that were fitted.
// transport_follows: channels that a quarter of their rows refuse clearly are left at that.
void estimate_dipole(Estimation& e, std::vector<std::optional<DipoleSystem>>* systems = nullptr,
                     bool transport_follows = false);
void estimate_auto(Estimation& e);
void estimate_transport(Estimation& e);
void estimate_paper(Estimation& e);

}  // namespace scattermeter
