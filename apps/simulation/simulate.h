// The raws that a rig would have shot of its truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "apps/simulation/shot_renderer.h"
#include "capture/raw/raw_frame.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct SimulateOptions {
  std::uint64_t seed = 1;
  bool noise = true;
  bool scene = true;               // the shots of the objects
  bool calibration = true;         // the shots of the rig's calibration
  RenderTransport transport = {};  // its seed is the one above
};

struct SimulatedShots {
  std::vector<std::string> paths;  // of the files
  double monte_carlo_std = 0;      // see ShotRenderer
};

// The board of pose.shot without noise, as the camera that takes all other shots sees it.
// Precondition: the rig has one. Throws InputError where it does not say where the camera stands.
capture::RawFrame board_frame(const Rig& rig);

// Writes every shot of the rig (VirtualShots) as a 12-bit DNG into `out_folder`, made where
// missing. Throws InputError for bad input; each file appears complete or not at all. Of peers
// (transport.peers) the first alone writes.
SimulatedShots simulate(const Rig& rig, const std::string& out_folder,
                        const SimulateOptions& options = {}, Progress* progress = nullptr);

}  // namespace scattermeter::apps
