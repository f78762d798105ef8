#include "core/estimation/far_eta.h"

#include <algorithm>
#include <cmath>

#include "core/estimation/model_choice.h"

namespace scattermeter {

bool finds_other_eta(const Estimate& estimate) {
  constexpr double kOther = 0.005;
  return !misses_image(estimate) &&
         std::any_of(estimate.pulls.begin(), estimate.pulls.end(), [](const PriorPull& p) {
           return p.group == "eta" && std::abs(p.offset) > kOther;
         });
}

std::vector<bool> take_far_etas(const std::vector<ChannelResult>& results, EtaOffsets& offsets) {
  constexpr double kGrid = 0.005;
  constexpr double kNew = 1.5 * kGrid;
  constexpr double kFarthest = 0.2;  // a fit that is still on its way
  std::vector<bool> taken(results.size());
  offsets.resize(results.size());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Estimate& e = results[i].estimate;
    // Where the dipole does not hold, its fit does not tell eta.
    if (!e.converged || misses_image(e)) continue;
    for (const PriorPull& p : e.pulls) {
      if (p.group != "eta" || std::abs(p.offset - offsets[i]) < kNew) continue;
      const double offset = kGrid * std::round(std::clamp(p.offset, -kFarthest, kFarthest) / kGrid);
      taken[i] = offset != offsets[i];
      offsets[i] = offset;
    }
  }
  return taken;
}

}  // namespace scattermeter
