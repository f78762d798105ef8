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

// Writes every shot of the rig as a 12-bit DNG into `out_folder` (made where missing), rendered
// with the dipole on the rig's truth materials. The camera stands at truth.pose, or where the pose
// points put it. Without an exposure time in the rig one is chosen for all shots so that the
// brightest sample reaches three quarters of the range; without a responsivity 0.1 s is taken and
// the responsivity chosen instead. Returns the paths written. Throws InputError for bad input; each
// file appears complete or not at all.
std::vector<std::string> simulate(const Rig& rig, const std::string& out_folder,
                                  const SimulateOptions& options);

}  // namespace scattermeter::apps
