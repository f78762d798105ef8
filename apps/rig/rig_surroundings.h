// Reading of what stands around the objects.
#pragma once

#include "apps/rig/yaml_field.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// The `surroundings` of a rig. Throws InputError naming file, line, field and value.
SceneSurroundings read_surroundings(const YamlField& field);

}  // namespace scattermeter::apps
