// Simulation of the shots of a rig's calibration.led.
#pragma once

#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "apps/simulation/simulate.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

// Writes the shots into `out_folder`, which must exist, and returns the paths of the files: none if
// the rig has no calibration.led. Throws InputError for bad input.
std::vector<std::string> simulate_led_calibration(const Rig& rig, const std::string& out_folder,
                                                  const SimulateOptions& options,
                                                  Progress* progress);

}  // namespace scattermeter::apps
