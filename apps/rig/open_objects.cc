#include "apps/rig/open_objects.h"

#include "capture/files/obj_reader.h"
#include "core/base/input_error.h"
#include "core/scene/surroundings.h"

namespace scattermeter::apps {

ObjectScenes open_objects(const Rig& rig) {
  return open_objects(rig, [&rig](const SceneObject& object) {
    return capture::read_obj(object.mesh_path, static_cast<std::size_t>(rig.limits.mesh_triangles));
  });
}

ObjectScenes open_objects(const Rig& rig,
                          const std::function<TriangleMesh(const SceneObject&)>& mesh_of) {
  ObjectScenes objects;
  for (const SceneShot& shot : rig.scene.shots) {
    const SceneObject& object = rig.scene.object(shot.object);
    if (objects.contains(object.name)) continue;
    TriangleMesh mesh;
    try {
      mesh = mesh_of(object);
    } catch (const InputError& e) {
      rethrow_at(rig.at(object.line) + ": objects." + object.name + ".mesh", e);
    }
    objects.emplace(object.name, object_scene(rig.scene, object, mesh));
  }
  require_lights_outside(rig.scene, objects);
  require_above_plane(rig.scene, objects);
  return objects;
}

}  // namespace scattermeter::apps
