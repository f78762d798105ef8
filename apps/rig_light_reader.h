// Reading a light of the rig.
#pragma once

#include <string>

#include "apps/rig.h"
#include "apps/yaml_field.h"

namespace scattermeter::apps {

// An LED, an environment or ambient light. Throws InputError naming file, line, field and value.
RigLight read_light(const std::string& name, const YamlField& field, const std::string& rig_path);

}  // namespace scattermeter::apps
