// The files that a rig's answer rests on.
#pragma once

#include <string>
#include <vector>

#include "apps/digest.h"
#include "apps/measure.h"
#include "apps/object_scene.h"
#include "apps/rig.h"

namespace scattermeter::apps {

// The rig, its calibrations, meshes and probes that a shot refers to, each once, then `more`, with
// their digests. Throws InputError naming a file that cannot be read.
std::vector<InputFile> rig_inputs(const Rig& rig, const ObjectScenes& scenes, FileDigests& digests,
                                  const std::vector<std::string>& more = {});

}  // namespace scattermeter::apps
