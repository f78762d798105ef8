// The input files of a measurement.
#pragma once

#include <string>
#include <vector>

#include "apps/instrument/measure.h"
#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "capture/files/digest.h"

namespace scattermeter::apps {

// The files with their digests: the rig, its calibrations, and the meshes and probes that a shot
// refers to, each once, then `more`. Throws InputError naming a file that cannot be read.
std::vector<InputFile> rig_inputs(const Rig& rig, const ObjectScenes& objects,
                                  capture::FileDigests& digests,
                                  const std::vector<std::string>& more = {});

}  // namespace scattermeter::apps
