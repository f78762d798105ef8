// Opening of the meshes of a rig's objects.
#pragma once

#include <functional>

#include "apps/rig/rig.h"
#include "core/mesh/triangle_mesh.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

// Opens the meshes of all objects that a shot refers to. Throws InputError naming line of the rig,
// object, mesh file and problem: unreadable, open, inside out, in metres, or an LED inside an
// object that it lights.
ObjectScenes open_objects(const Rig& rig);

// The same with meshes that do not come from the rig's files; mesh_of may throw InputError.
ObjectScenes open_objects(const Rig& rig,
                          const std::function<TriangleMesh(const SceneObject&)>& mesh_of);

}  // namespace scattermeter::apps
