#include "apps/instrument/shot_summary.h"

#include <algorithm>
#include <cstddef>
#include <set>

#include <fmt/core.h>

namespace scattermeter::apps {

std::vector<MergedBracket> brackets_of(const std::vector<ObservedShot>& shots) {
  std::vector<MergedBracket> out;
  for (const ObservedShot& shot : shots) {
    if (shot.exposures.size() < 2) continue;
    MergedBracket& bracket = out.emplace_back();
    bracket.shot = shot.stated->file;
    for (std::size_t c = 0; c < kRgb; ++c) {
      bracket.samples[c] = shot.observation.channel[c].samples;
      bracket.samples_clipped[c] = shot.observation.channel[c].samples_clipped;
    }
    for (std::size_t k = 0; k < shot.exposures.size(); ++k) {
      MergedBracket::File& file = bracket.files.emplace_back();
      file.file = shot.exposures[k].file;
      file.exposure_s = shot.exposures[k].true_s;
      file.departure = shot.exposures[k].departure;
      for (std::size_t c = 0; c < kRgb; ++c) {
        file.samples[c] = shot.observation.channel[c].exposures[k].samples;
      }
    }
  }
  return out;
}

Skipped skipped_of(const std::vector<ObservedShot>& shots, const LitObjects& lit) {
  Skipped out;
  std::set<const SeenObject*> views;
  for (const ObservedShot& shot : shots) {
    out.samples_outside += shot.samples_outside;
    if (views.insert(shot.seen.get()).second) {
      out.patches_unseen +=
          static_cast<std::size_t>(shot.seen->patches->size()) - shot.seen->map.patch_of_row.size();
    }
  }
  for (const IncidentLight* light : lit.lights_so_far()) {
    out.patches_unlit += static_cast<std::size_t>(
        std::count(light->patch_power_sr.begin(), light->patch_power_sr.end(), 0.0));
    out.shadow_rays += light->shadow_rays_skipped;
  }
  return out;
}

std::string noise_note(const std::vector<ObservedShot>& shots) {
  std::size_t noisy = 0;
  double most = 1.0;
  std::string where;
  for (const ObservedShot& shot : shots) {
    for (std::size_t c = 0; c < kRgb; ++c) {
      const double excess = shot.observation.channel[c].noise_excess;
      if (excess > 1.0) ++noisy;
      if (excess > most) {
        most = excess;
        where = fmt::format("{} {}", shot.stated->file, kRgbName[c]);
      }
    }
  }
  if (noisy == 0) return "";
  return fmt::format(
      "noise: {} of {} channels of shots are noisier than stated, {} the most ({:.2g} times the "
      "variance); they count with the noise that they have; set camera.sensor gain_e_per_count and "
      "read_noise_counts for this ISO",
      noisy, kRgb * shots.size(), where, most);
}

}  // namespace scattermeter::apps
