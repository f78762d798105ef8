// Reading of where an object stands.
#pragma once

#include "apps/rig/yaml_field.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// Reads `objects.NAME.pose`: where the mesh stands in the world, or about where it is to be found.
// Throws InputError with file, line, field and value.
void read_place(const YamlField& field, SceneObject& object);

// Puts an object of its own, named "NAME in FILE", in place of each standing of a piece that was
// moved between its shots (PieceSearch::is_per_shot). A piece without shots stays as it is.
void separate_standings(Scene& scene);

}  // namespace scattermeter::apps
