#include "apps/deviations/deviation.h"

#include <algorithm>
#include <stdexcept>

namespace scattermeter::apps {

const std::vector<Deviation>& all_deviations() {
  static const std::vector<Deviation> all = [] {
    std::vector<Deviation> out = {
        {.name = "none", .words = {}, .unit = "", .sizes = {0}, .within = 1}};
    for (const auto& rows :
         {mesh_deviations(), led_deviations(), stray_light_deviations(), camera_deviations(),
          sensor_deviations(), object_deviations(), drawn_deviations()}) {
      out.insert(out.end(), rows.begin(), rows.end());
    }
    return out;
  }();
  return all;
}

const Deviation& deviation_named(const std::string& name) {
  const std::vector<Deviation>& all = all_deviations();
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const Deviation& d) { return d.name == name; });
  if (it != all.end()) return *it;
  std::string known;
  for (const Deviation& d : all) known += (known.empty() ? "" : ", ") + d.name;
  throw std::invalid_argument("deviation: unknown kind " + name + "; there are: " + known);
}

}  // namespace scattermeter::apps
