#include "core/estimation/sensitivities.h"

#include <algorithm>
#include <functional>
#include <tuple>

#include <oneapi/tbb/parallel_for.h>

#include "core/base/progress.h"
#include "core/nuisances/edge_light.h"
#include "core/nuisances/even_light.h"
#include "core/nuisances/surroundings_nuisance.h"
#include "core/scene/surroundings.h"

namespace scattermeter {
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
  const SceneLight& stated = e.scene.light(light);
  if (kept == nullptr) {
    return changed_images(*seen, stated, channel, e.lit, knots, media);
  }
  if (kept->nominal.size() == 0) {
    *kept = changed_weights(*seen, stated, channel, e.lit, knots, e.kept.store.get());
  }
  return changed_images(*seen, *kept, knots, media);
}

// The media of the channels under a light.
struct Wanted {
  std::vector<LitMedium> media;
  std::vector<double> widths_mm, eta_offsets;  // of each, as in ChangesAt
};

// The light of an LED on an object above a plane that may change its image; else null. Not at the
// same time as any other light.
const IncidentLight* light_above_plane(const Estimation& e, const LightKey& key) {
  const auto& [seen, name, channel] = key;
  if (name.empty() || e.scene.light(name).led() == nullptr) return nullptr;
  if (!plane_below(e.scene, *seen->object).matters()) return nullptr;
  return &e.lit.light(seen->object->stated->name, name, channel);
}

}  // namespace

std::vector<bool> take_found(const Scene& scene, const std::vector<ChannelResult>& results,
                             ChangesAt& at) {
  std::vector<bool> taken = take_edge_widths(scene, results, at.edge_widths_mm);
  const std::vector<bool> far = take_far_etas(results, at.eta_offsets);
  std::transform(taken.begin(), taken.end(), far.begin(), taken.begin(), std::logical_or<>());
  return taken;
}

std::shared_ptr<const Sensitivities> sensitivities(const Estimation& e,
                                                   const std::vector<bool>& estimated,
                                                   const DistanceKnots& knots,
                                                   const ChangesAt& at) {
  std::map<LightKey, Wanted> wanted;
  std::vector<std::map<LightKey, Eigen::Index>> column(e.channels.size());
  for (std::size_t i = 0; i < e.channels.size(); ++i) {
    if (!estimated[i]) continue;
    const Estimate& first = e.results[i].estimate;
    const auto add = [&](const LightKey& key) {
      Wanted& of_light = wanted[key];
      const auto n = static_cast<Eigen::Index>(of_light.media.size());
      if (!column[i].try_emplace(key, n).second) return;
      of_light.media.push_back(lit_medium(first));
      const SceneObject& object = *std::get<0>(key)->object->stated;
      const auto width = at.edge_widths_mm.find({e.channels[i].material, object.name});
      of_light.widths_mm.push_back(width == at.edge_widths_mm.end() ? chamfer_width_mm(object)
                                                                    : width->second);
      of_light.eta_offsets.push_back(at.eta_offsets.empty() ? 0.0 : at.eta_offsets[i]);
    };
    for (const ObservedShot* shot : e.channels[i].shots) {
      for (const std::string& light : shot->stated->lights) {
        add({shot->seen.get(), light, e.scene.light(light).channel_of(e.channels[i].channel)});
      }
      if (may_have_even_light(e.scene, *shot)) add(even_light_key(*shot));
    }
  }
  const auto made = std::make_shared<Sensitivities>();
  Sensitivities& all = *made;
  ProgressStage stage(e.progress, "uncertainties", wanted.size());
  struct Item {
    const LightKey& key;
    const Wanted& wanted;
    ChangedWeights* kept;
    LightSensitivity& out;
    const IncidentLight* direct;  // of an LED above a plane that matters; else null
  };
  std::vector<Item> alike, apart;  // in the channels
  for (const auto& [key, of_light] : wanted) {
    const bool is_even = std::get<1>(key).empty();
    const bool is_one = is_even || e.scene.light(std::get<1>(key))->channels() == 1;
    (is_one ? alike : apart)
        .push_back({key, of_light,
                    !is_even && may_be_kept(key, knots) ? &e.kept.changed[key] : nullptr,
                    all.by_light[key], light_above_plane(e, key)});
  }
  const auto make = [&](const Item& item) {
    const SeenObject& seen = *std::get<0>(item.key);
    const std::vector<LitMedium>& media = item.wanted.media;
    if (std::get<1>(item.key).empty()) {
      item.out.l = even_light_images(seen, knots, media, e.kept.store.get());
      const auto by_axis =
          light_from_axes_images(seen, knots, media, item.out.l, e.kept.store.get());
      item.out.per_change.assign(by_axis.begin(), by_axis.end());
      return stage.step();
    }
    item.out = sensitivity(seen, e.kept.weights.at(item.key),
                           images_of(e, item.key, media, knots, item.kept), media, knots);
    const SceneLight& light = e.scene.light(std::get<1>(item.key));
    set_far_per_eta(seen, light, std::get<2>(item.key), e.lit, knots, media,
                    item.wanted.eta_offsets, item.out);
    if (const LedLight* led = light.led()) {
      item.out.per_edge_mm =
          change_by_edges(seen, led->led, knots, media, item.wanted.widths_mm, e.kept.store.get());
    }
    if (item.direct != nullptr) {
      item.out.per_albedo = change_by_plane(seen, light.led()->led, *item.direct,
                                            plane_below(e.scene, *seen.object), knots, media);
    }
    stage.step();
  };
  tbb::parallel_for(std::size_t{0}, alike.size(), [&](std::size_t k) { make(alike[k]); });
  // The lit objects make one such light at a time.
  for (const Item& item : apart) make(item);
  all.of_channel.resize(e.channels.size());
  for (std::size_t i = 0; i < e.channels.size(); ++i) {
    for (const auto& [key, medium] : column[i]) {
      all.of_channel[i][key] = {&all.by_light.at(key), medium};
    }
  }
  return made;
}

}  // namespace scattermeter
