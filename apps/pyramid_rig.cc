#include "apps/pyramid_rig.h"

#include <stdexcept>
#include <utility>

#include "apps/bodies.h"
#include "apps/studio.h"

namespace scattermeter::apps {

Rig pyramid_rig(int image_width_px, std::shared_ptr<const Environment> probe) {
  if (!probe) throw std::invalid_argument("pyramid_rig: no probe");
  Rig rig;
  rig.path = "pyramid_rig";
  set_up_camera(rig, image_width_px);
  RigObject object;
  object.name = "pyramid";
  object.eta_int_over_ext = 1.3;
  rig.objects = {object};
  RigLight light;
  light.name = "probe";
  light.environment = RigEnvironment{};
  light.environment->projection = probe->projection;
  light.environment->world_from_probe = probe->world_from_probe;
  light.environment->image = std::move(probe);
  rig.lights = {light};
  RigShot shot;
  shot.file = "pyramid.dng";
  shot.object = "pyramid";
  shot.material = "pyramid";
  shot.lights = {"probe"};
  rig.shots = {shot};
  const Medium medium{2.19, 0.002, 1.0};
  rig.truth_materials["pyramid"] = {medium, medium, medium};
  return rig;
}

ObjectScenes pyramid_scenes(const Rig& rig) {
  return open_objects(rig, [](const RigObject&) { return pyramid_mesh(); });
}

}  // namespace scattermeter::apps
