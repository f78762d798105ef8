// Reading a light of the rig.
#pragma once

#include <string>

#include "apps/rig/rig_limits.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

class YamlField;

// Of a kind that the table in rig_light_reader.cc lists. The picture of an environment is read when
// the light is first needed. Throws InputError naming file, line, field and value.
SceneLight read_light(const std::string& name, const YamlField& field, const std::string& rig_path,
                      const RigLimits& limits);

}  // namespace scattermeter::apps
