#include "apps/object_scene.h"

#include <sstream>

#include "capture/obj_reader.h"
#include "core/input_error.h"

namespace scattermeter::apps {
namespace {

std::string text(const Eigen::Vector3d& v) {
  std::ostringstream out;
  out << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
  return out.str();
}

}  // namespace

ObjectScenes open_objects(const Rig& rig) {
  return open_objects(rig, [&rig](const RigObject& object) {
    return capture::read_obj(object.mesh_path, static_cast<std::size_t>(rig.limits.mesh_triangles));
  });
}

ObjectScenes open_objects(const Rig& rig,
                          const std::function<TriangleMesh(const RigObject&)>& mesh_of) {
  ObjectScenes scenes;
  for (const RigShot& shot : rig.shots) {
    const RigObject& object = rig.object(shot.object);
    auto [it, is_new] = scenes.try_emplace(object.name);
    if (is_new) {
      const std::string where = rig.at(object.line) + ": objects." + object.name + ".mesh";
      TriangleMesh mesh;
      try {
        mesh = mesh_of(object);
      } catch (const InputError& e) {
        throw InputError(where, e.what());
      }
      if (const std::string problem = mesh_problem(mesh); !problem.empty()) {
        throw InputError(where, object.mesh_path + ": " + problem);
      }
      it->second.rig = &object;
      it->second.box = bounds(mesh);
      it->second.rays = std::make_unique<RayScene>(mesh);
    }
    for (const std::string& name : shot.lights) {
      const RigLight& light = rig.light(name);
      if (light.environment) continue;
      if (it->second.rays->contains(light.led.position_mm)) {
        throw InputError(
            rig.at(light.line) + ": lights." + name + ".position_mm",
            "the LED at " + text(light.led.position_mm) + " lies inside object " + object.name);
      }
    }
  }
  return scenes;
}

void require_in_view(const Rig& rig, const ObjectScenes& objects, const CameraView& view,
                     const std::string& name) {
  const ObjectScene& object = objects.at(name);
  const std::string where = rig.at(object.rig->line) + ": objects." + name;
  const std::string camera = "the camera at " + text(view.center_in_world_mm());
  if (object.rays->contains(view.center_in_world_mm())) {
    throw InputError(where, camera + " lies inside the object");
  }
  const ViewCheck check = check_view(view, object.mesh());
  if (!check.in_front) throw InputError(where, "the object lies behind " + camera);
  if (!check.in_frame) throw InputError(where, "the object lies outside the frame of " + camera);
}

}  // namespace scattermeter::apps
