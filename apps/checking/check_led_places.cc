#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "apps/checking/check.h"

namespace scattermeter::apps {

// Every material and channel tells a place of its own; the tenth of a millimetre that they may
// differ by, as none of them is a half-space, is not in their deviations, so the plain mean counts.
std::vector<CheckItem> check_led_places(const CheckedRig& checked) {
  std::vector<CheckDetail> details;
  double own_std_mm = 0.0;
  for (const SceneLight& light : checked.rig.scene.lights) {
    if (light.led() == nullptr) continue;
    std::array<double, 3> mean_mm{};
    std::array<double, 3> variance_mm2{};
    double n = 0.0;
    for (const CheckedTask& task : checked.fit.tasks) {
      if (!task.departures) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string name = light.name + ".position" + std::to_string(axis);
        for (std::size_t k = 0; k < task.nuisances.size(); ++k) {
          if (task.nuisances[k].name != name) continue;
          mean_mm[axis] += task.departures->nuisances[k].value;
          variance_mm2[axis] += std::pow(task.departures->nuisances[k].std, 2);
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
      // The channels share the shots' geometry: as uncertain as one of them.
      d.std = std::sqrt(variance_mm2[axis] / n);
      details.push_back(d);
    }
  }
  const CheckLimit limit{checked.options.max_led_place_mm + 3.0 * own_std_mm, false, false,
                         checked.options.least_stds};
  return {judged("LED place", "mm off the rig's", limit,
                 "measure lights.position_mm again (calibrate led), or say how well it is known",
                 details)};
}

}  // namespace scattermeter::apps
