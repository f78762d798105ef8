// Reading of a light of the rig.
#pragma once

#include <string>

#include "apps/rig/rig_limits.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

class YamlField;

// Reads a light of any kind in the table of rig_light_reader.cc. The picture of an environment is
// read when the light is first needed. Throws InputError with file, line, field and value.
SceneLight read_light(const std::string& name, const YamlField& field, const std::string& rig_path,
                      const RigLimits& limits);

}  // namespace scattermeter::apps
