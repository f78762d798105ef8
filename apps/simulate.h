// The raws that a rig would have shot of its truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/rig.h"

namespace scattermeter::apps {

struct SimulateOptions {
  std::uint64_t seed = 1;
  bool noise = true;
  bool quiet = false;
};

// Writes every shot of the rig (VirtualShots) as a 12-bit DNG into `out_folder`, made where
// missing. Returns the paths written. Throws InputError for bad input; each file appears complete
// or not at all.
std::vector<std::string> simulate(const Rig& rig, const std::string& out_folder,
                                  const SimulateOptions& options);

}  // namespace scattermeter::apps
