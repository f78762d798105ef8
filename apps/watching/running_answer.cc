#include "apps/watching/running_answer.h"

#include <utility>

#include "apps/planning/plan.h"
#include "core/camera/channel_index.h"

namespace scattermeter::apps {

std::vector<std::array<double, 2>> forecast(Rig rig, const ObjectScenes& objects,
                                            const std::string& material,
                                            const std::vector<ChannelResult>& channels,
                                            const std::vector<std::size_t>& shot_idxs) {
  std::array<Medium, kRgb>& media = rig.truth.materials[material];
  for (const ChannelResult& c : channels) {
    if (c.refused() || !(c.estimate.sigma_a_per_mm.value > 0.0)) return {};
    media.at(channel_index(c.channel)) = {c.estimate.sigma_s_prime_per_mm.value,
                                          c.estimate.sigma_a_per_mm.value, 1.0};
  }
  std::vector<SceneShot> shots;
  for (const std::size_t i : shot_idxs) shots.push_back(rig.scene.shots.at(i));
  rig.scene.shots = std::move(shots);
  PlanOptions options;
  options.suggested_shots = false;
  std::vector<std::array<double, 2>> out;
  for (const PlannedChannel& c : plan(rig, objects, options).channels) {
    out.push_back({relative_range(c, &Estimate::sigma_s_prime_per_mm).high,
                   relative_range(c, &Estimate::sigma_a_per_mm).high});
  }
  return out;
}

}  // namespace scattermeter::apps
