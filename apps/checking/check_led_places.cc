#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "apps/checking/check.h"

namespace scattermeter::apps {

// Each material and channel yields a position of its own. They may differ by a tenth of a
// millimetre, as no object is a half-space; this is not part of their standard deviations, so the
// mean is not weighted.
std::vector<CheckItem> check_led_places(const CheckedRig& checked) {
  std::vector<CheckDetail> details;
  double own_std_mm = 0.0;
  for (const SceneLight& light : checked.rig.scene.lights) {
    if (light.led() == nullptr) continue;
    std::array<double, 3> mean_mm{};
    std::array<double, 3> variance_mm2{};
    double n = 0.0;
    for (const CheckedChannel& fitted : checked.fit.channels) {
      if (!fitted.departures) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string name = light.name + ".position" + std::to_string(axis);
        for (std::size_t k = 0; k < fitted.nuisances.size(); ++k) {
          if (fitted.nuisances[k].name != name) continue;
          mean_mm[axis] += fitted.departures->nuisances[k].value;
          variance_mm2[axis] += std::pow(fitted.departures->nuisances[k].std, 2);
          if (axis == 0) n += 1.0;
        }
      }
    }
    if (n == 0.0) continue;
    own_std_mm = std::max(own_std_mm, light.led()->position_std_mm);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CheckDetail d;
      d.where = fmt::format("{} along {}", light.name, "xyz"[axis]);
      d.value = mean_mm[axis] / n;
      // The channels share the geometry of the shots: the mean is no more certain than one of them.
      d.std = std::sqrt(variance_mm2[axis] / n);
      details.push_back(d);
    }
  }
  const CheckLimit limit{checked.options.max_led_place_mm + 3.0 * own_std_mm, false, false,
                         checked.options.least_stds};
  return {judged("LED place", "mm off the rig's", limit,
                 "measure lights.position_mm again (calibrate led), or state its uncertainty",
                 details)};
}

}  // namespace scattermeter::apps
