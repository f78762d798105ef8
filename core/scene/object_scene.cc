#include "core/scene/object_scene.h"

#include <sstream>
#include <utility>

#include "core/base/input_error.h"
#include "core/mesh/creases.h"
#include "core/mesh/turning_symmetry.h"

namespace scattermeter {
namespace {

std::string text(const Eigen::Vector3d& v) {
  std::ostringstream out;
  out << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
  return out.str();
}

}  // namespace

ObjectScene object_scene(const Scene& scene, const SceneObject& object, const TriangleMesh& mesh) {
  if (const std::string problem = mesh_problem(mesh); !problem.empty()) {
    throw InputError(scene.at(object.line) + ": objects." + object.name + ".mesh",
                     object.mesh_path + ": " + problem);
  }
  TriangleMesh moved = mesh;
  for (Eigen::Vector3d& v : moved.vertices_mm) v = object.world_from_mesh * v;
  ObjectScene out;
  out.stated = &object;
  out.box = bounds(moved);
  out.rays = std::make_unique<RayScene>(std::move(moved));
  out.is_round = is_round(out.mesh());
  out.displacing_turns = displacing_turns(out.mesh(), out.box.center_mm());
  return out;
}

void require_lights_outside(const Scene& scene, const ObjectScenes& objects) {
  for (const SceneShot& shot : scene.shots) {
    for (const std::string& name : shot.lights) {
      const SceneLight& light = scene.light(name);
      const auto position_mm = light->position_mm();
      if (position_mm && objects.at(shot.object).rays->contains(*position_mm)) {
        throw InputError(scene.at(light.line) + ": lights." + name + ".position_mm",
                         "the LED at " + text(*position_mm) + " lies inside object " + shot.object);
      }
    }
  }
}

void require_in_view(const Scene& scene, const ObjectScenes& objects, const CameraView& view,
                     const std::string& name) {
  const ObjectScene& object = objects.at(name);
  const std::string where = scene.at(object.stated->line) + ": objects." + name;
  const std::string camera = "the camera at " + text(view.center_in_world_mm());
  if (object.rays->contains(view.center_in_world_mm())) {
    throw InputError(where, camera + " lies inside the object");
  }
  const auto& plane = scene.surroundings.plane;
  if (plane && !(view.center_in_world_mm().z() > plane->z_mm)) {
    throw InputError(scene.at(plane->line) + ": surroundings.plane.z_mm",
                     camera + " is not above the plane");
  }
  const ViewCheck check = check_view(view, object.mesh());
  if (!check.in_front) throw InputError(where, "the object lies behind " + camera);
  if (!check.in_frame) throw InputError(where, "the object lies outside the frame of " + camera);
}

}  // namespace scattermeter
