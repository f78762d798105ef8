#include "core/scene/surroundings.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/base/input_error.h"
#include "core/light/plane_entry.h"
#include "core/light/rough_entry.h"

namespace scattermeter {
namespace {

constexpr double kStandAlbedo = 0.04;
constexpr double kStandAlbedoStd = 0.04;

bool lies_on(const TriangleMesh& mesh, double z_mm, double touching_mm) {
  return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
    return std::all_of(triangle.begin(), triangle.end(), [&](int vertex) {
      return mesh.vertices_mm[static_cast<std::size_t>(vertex)].z() - z_mm < touching_mm;
    });
  });
}

}  // namespace

ScenePlane plane_below(const Scene& scene, const ObjectScene& object) {
  if (scene.surroundings.plane) return *scene.surroundings.plane;
  ScenePlane stand;
  stand.z_mm = object.box.min_mm.z();
  stand.albedo.setConstant(kStandAlbedo);
  stand.albedo_std.setConstant(kStandAlbedoStd);
  return stand;
}

std::unique_ptr<EntrySource> entry_above(const SceneLight& light, const RayScene& scene,
                                         double eta_int_over_ext, int channel,
                                         const DiffusePlane& plane, double surface_alpha) {
  if (surface_alpha > 0.0) {
    return rough_entry(entry_above(light, scene, 1.0, channel, plane), surface_alpha,
                       eta_int_over_ext);
  }
  if (light.led() != nullptr) {
    return led_entry_above(scene, light.led()->led, plane, eta_int_over_ext);
  }
  return light->entry(scene, eta_int_over_ext, channel);
}

void require_above_plane(const Scene& scene, const ObjectScenes& objects) {
  if (!scene.surroundings.plane) return;
  const ScenePlane& plane = *scene.surroundings.plane;
  const std::string where = scene.at(plane.line) + ": surroundings.";
  for (const auto& [name, object] : objects) {
    const double touching_mm = DiffusePlane::touching_mm(object.size_mm());
    const double lowest_mm = object.box.min_mm.z();
    if (lowest_mm < plane.z_mm - touching_mm) {
      throw InputError(where + "plane.z_mm",
                       fmt::format("object {} reaches down to z = {} mm, below the plane at {} mm",
                                   name, lowest_mm, plane.z_mm));
    }
    if (plane.contact != PlaneContact::kAir && !lies_on(object.mesh(), plane.z_mm, touching_mm)) {
      throw InputError(
          where + "contact",
          fmt::format("no face of object {} lies on the plane at z = {} mm: its lowest "
                      "point is at {} mm",
                      name, plane.z_mm, lowest_mm));
    }
  }
  for (const SceneShot& shot : scene.shots) {
    for (const std::string& name : shot.lights) {
      const SceneLight& light = scene.light(name);
      const auto position_mm = light->position_mm();
      if (position_mm && !(position_mm->z() > plane.z_mm)) {
        throw InputError(scene.at(light.line) + ": lights." + name + ".position_mm",
                         fmt::format("the LED at z = {} mm is not above the plane of the "
                                     "surroundings at {} mm",
                                     position_mm->z(), plane.z_mm));
      }
    }
  }
}

}  // namespace scattermeter
