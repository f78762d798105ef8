#include "core/estimation/estimation.h"

#include <limits>
#include <utility>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "core/base/progress.h"
#include "core/camera/channel_index.h"

namespace scattermeter {

Estimation::Estimation(const Scene& of_scene, LitObjects& lit_objects,
                       std::span<const ObservedShot> observed, std::vector<MaterialChannel> wanted,
                       const EstimateOptions& estimate_options, KeptLight& kept_light,
                       Stopwatch& stopwatch, Progress* reported_to)
    : scene(of_scene),
      lit(lit_objects),
      shots(observed),
      options(estimate_options),
      kept(kept_light),
      watch(stopwatch),
      progress(reported_to),
      channels(std::move(wanted)) {
  for (const MaterialChannel& channel : channels) {
    ChannelResult& result = results.emplace_back();
    result.material = channel.material;
    result.channel = kRgbName[channel.channel];
    result.eta_int_over_ext = channel.eta_int_over_ext;
    for (const ObservedShot* shot : channel.shots) {
      result.shots.push_back(shot->stated->file);
      if (const std::string problem = shot_problem(*shot, channel.channel); !problem.empty()) {
        result.estimate.reasons.push_back(problem);
      }
    }
  }
}

void Estimation::for_open_channels(const std::string& stage_name,
                                   const std::function<void(std::size_t)>& work) const {
  ProgressStage stage(progress, stage_name, channels.size());
  tbb::parallel_for(std::size_t{0}, channels.size(), [&](std::size_t i) {
    if (!results[i].refused()) work(i);
    stage.step();
  });
}

void Estimation::refuse_rough_surfaces() {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!(channels[i].surface_alpha > 0.0)) continue;
    results[i].estimate.reasons.push_back(
        fmt::format("the surface is rough (alpha {:g}), for which only transport is a model",
                    channels[i].surface_alpha));
  }
}

ScalePrior scale_prior(const Scene& scene) {
  if (!scene.camera.responsivity) return {std::numeric_limits<double>::infinity()};
  return {scene.camera.responsivity_relative_std};
}

}  // namespace scattermeter
