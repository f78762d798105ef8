// Reading of the roughness of an object's surface.
#pragma once

#include "apps/rig/yaml_field.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// Reads `objects.NAME.roughness` into surface_alpha and surface_alpha_std: numbers, or the name of
// a finish. Throws InputError with file, line, field and value.
void read_roughness(const YamlField& field, SceneObject& object);

// Throws InputError where a shot shows a rough object under light whose reflection on it is not
// modelled: that of a picture of the surroundings.
void require_lights_of_rough_objects(const Scene& scene);

}  // namespace scattermeter::apps
