#include "apps/simulation/pyramid_rig.h"

#include <stdexcept>
#include <utility>

#include "apps/rig/open_objects.h"
#include "apps/simulation/synthetic_camera.h"
#include "core/mesh/bodies.h"

namespace scattermeter::apps {

Rig pyramid_rig(int image_width_px, std::shared_ptr<const Environment> probe) {
  if (!probe) throw std::invalid_argument("pyramid_rig: no probe");
  Rig rig;
  rig.path = "pyramid_rig";
  set_up_camera(rig, image_width_px);
  SceneObject object;
  object.name = "pyramid";
  object.eta_int_over_ext = 1.3;
  rig.scene.objects = {object};
  SceneLight light;
  light.name = "probe";
  light.kind = DistantLight([probe = std::move(probe)] { return *probe; });
  rig.scene.lights = {light};
  SceneShot shot;
  shot.file = "pyramid.dng";
  shot.object = "pyramid";
  shot.material = "pyramid";
  shot.lights = {"probe"};
  rig.scene.shots = {shot};
  const Medium medium{2.19, 0.002, 1.0};
  rig.truth.materials["pyramid"] = {medium, medium, medium};
  return rig;
}

ObjectScenes pyramid_scenes(const Rig& rig) {
  return open_objects(rig, [](const SceneObject&) { return pyramid_mesh(); });
}

}  // namespace scattermeter::apps
