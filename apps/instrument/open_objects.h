// The meshes of a rig's objects, opened.
#pragma once

#include <functional>

#include "apps/rig/rig.h"
#include "core/mesh/triangle_mesh.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

// Opens the meshes of all objects that a shot refers to. Throws InputError naming rig line, object,
// mesh file and what is wrong: unreadable, open, inside out, in metres; or an LED inside an object
// that it lights.
ObjectScenes open_objects(const Rig& rig);

// The same with meshes from elsewhere than the rig's files; the callback may throw InputError.
ObjectScenes open_objects(const Rig& rig,
                          const std::function<TriangleMesh(const SceneObject&)>& mesh_of);

}  // namespace scattermeter::apps
