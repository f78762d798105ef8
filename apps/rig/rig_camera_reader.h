// Reading of a rig's camera.
#pragma once

#include "apps/rig/rig.h"
#include "apps/rig/yaml_field.h"

namespace scattermeter::apps {

// Reads the section `camera` into rig.scene.camera and, from the files that it names, the lens and
// the radiance calibration (without with_radiance, the latter is ignored). rig.path and
// rig.limits must be set. Throws InputError with file, line, field and value.
void read_camera(const YamlField& field, bool with_radiance, Rig& rig);

}  // namespace scattermeter::apps
