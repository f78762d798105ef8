#include "apps/simulation/simulate_led_calibration.h"

#include <filesystem>

#include "apps/simulation/virtual_led_shots.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

std::vector<std::string> simulate_led_calibration(const Rig& rig, const std::string& out_folder,
                                                  const SimulateOptions& options,
                                                  Progress* /*progress*/) {
  std::vector<std::string> paths;
  if (!rig.calibration.led) return paths;
  const VirtualLedShots shots(rig, options.noise);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    paths.push_back(
        (std::filesystem::path(out_folder) / rig.calibration.led->shots[i].file).string());
    shots.write(i, options.seed, paths.back());
  }
  return paths;
}

}  // namespace scattermeter::apps
