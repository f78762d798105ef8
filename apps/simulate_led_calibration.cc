#include "apps/simulate_led_calibration.h"

namespace scattermeter::apps {

std::vector<std::string> simulate_led_calibration(const Rig& rig, const std::string& out_folder,
                                                  const SimulateOptions& options) {
  static_cast<void>(out_folder);
  static_cast<void>(options);
  static_cast<void>(rig);
  return {};
}

}  // namespace scattermeter::apps
