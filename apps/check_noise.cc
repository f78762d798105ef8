#include "apps/check_stations.h"

namespace scattermeter::apps {

std::vector<CheckItem> check_noise(const CheckedRig& checked) {
  std::vector<CheckDetail> ratios;
  for (std::size_t i = 0; i < checked.shots.size(); ++i) {
    for (std::size_t c = 0; c < kRgb; ++c) {
      ratios.push_back(
          checked.of_channel(i, c, checked.shots[i].observation.channel[c].noise_ratio));
    }
  }
  return {judged("noise", "x the model's variance", {checked.options.max_noise_ratio},
                 "set camera.sensor gain and read noise for this ISO", ratios)};
}

}  // namespace scattermeter::apps
