// Simulated raw shots of a rig's truth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "apps/simulation/shot_renderer.h"
#include "capture/raw/raw_frame.h"
#include "capture/raw/raw_metadata.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

struct SimulateOptions {
  std::uint64_t seed = 1;
  bool noise = true;
  bool scene = true;        // the shots of the objects
  bool calibration = true;  // the shots of the rig's calibration
  capture::RawFormat format = capture::RawFormat::kDng;
  RenderTransport transport = {};  // its seed is the one above
};

struct SimulatedLevel {
  std::string file;  // name in the rig
  double exposure_s = 0;
  double brightest_share = 0;  // see VirtualShots
};

struct SimulatedShots {
  std::vector<std::string> paths;      // of the files
  std::vector<SimulatedLevel> levels;  // of the objects' shots
  double monte_carlo_std = 0;          // see ShotRenderer
};

// The shot of the board that pose.shot names, without noise, from the camera of the other shots.
// Precondition: the rig names one. Throws InputError if the rig has no pose of the camera.
capture::RawFrame board_frame(const Rig& rig);

// Writes every shot of the rig (VirtualShots) as a 12-bit raw file into `out_folder`, which is
// created if it is missing. A NEF is that of a D80, whatever camera.sensor.tone_curve says: with
// the lossy tone curve; the rig's model must be a D80 or open, its white level 4095. Files have the
// names in the rig. Throws InputError for bad input; each file appears complete or not at all. With
// peers (transport.peers), only the first writes.
SimulatedShots simulate(const Rig& rig, const std::string& out_folder,
                        const SimulateOptions& options = {}, Progress* progress = nullptr);

}  // namespace scattermeter::apps
