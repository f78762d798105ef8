#include "apps/sensitivities.h"

#include <tuple>

#include <oneapi/tbb/parallel_for.h>

#include "apps/progress.h"

namespace scattermeter::apps {
namespace {

// The changed W are kept for other media and other shots where there is room for some ten of them.
bool may_be_kept(const LightKey& key, const DistanceKnots& knots) {
  constexpr std::size_t kRoomForNumbers = 1 << 25;  // 256 MiB
  return 10 * std::get<0>(key)->sites.size() * static_cast<std::size_t>(knots.size()) <=
         kRoomForNumbers;
}

// kept: those of the light; filled if empty; null: not to be kept.
ChangedImages images_of(const Estimation& e, const LightKey& key,
                        const std::vector<LitMedium>& media, const DistanceKnots& knots,
                        ChangedWeights* kept) {
  const auto& [seen, light, channel] = key;
  const RigLight& rig_light = e.rig.light(light);
  if (kept == nullptr) {
    return changed_images(*seen, rig_light, channel, e.library, knots, media);
  }
  if (kept->nominal.size() == 0) {
    *kept = changed_weights(*seen, rig_light, channel, e.library, knots);
  }
  return changed_images(*seen, *kept, knots, media);
}

}  // namespace

std::shared_ptr<const Sensitivities> sensitivities(const Estimation& e,
                                                   const std::vector<bool>& estimated,
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
  const auto made = std::make_shared<Sensitivities>();
  Sensitivities& all = *made;
  Progress progress("uncertainties", static_cast<int>(media.size()), e.options.quiet);
  struct Item {
    const LightKey& key;
    const std::vector<LitMedium>& media;
    ChangedWeights* kept;
    LightSensitivity& out;
  };
  std::vector<Item> leds, environments;
  for (const auto& [key, list] : media) {
    const bool is_led = !e.rig.light(std::get<1>(key)).environment;
    (is_led ? leds : environments)
        .push_back({key, list, may_be_kept(key, knots) ? &e.changed_weights[key] : nullptr,
                    all.by_light[key]});
  }
  const auto make = [&](const Item& item) {
    item.out = sensitivity(*std::get<0>(item.key), e.weights.at(item.key),
                           images_of(e, item.key, item.media, knots, item.kept), item.media, knots);
    progress.step();
  };
  tbb::parallel_for(std::size_t{0}, leds.size(), [&](std::size_t k) { make(leds[k]); });
  // The library makes one environment's light at a time.
  for (const Item& item : environments) make(item);
  all.of_task.resize(e.tasks.size());
  for (std::size_t i = 0; i < e.tasks.size(); ++i) {
    for (const auto& [key, medium] : column[i]) {
      all.of_task[i][key] = {&all.by_light.at(key), medium};
    }
  }
  return made;
}

}  // namespace scattermeter::apps
