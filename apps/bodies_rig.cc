#include "apps/bodies_rig.h"

#include "apps/bodies.h"
#include "apps/studio.h"

namespace scattermeter::apps {

Rig bodies_rig(int image_width_px, double eta_int_over_ext,
               const std::vector<NamedMedia>& materials) {
  Rig rig;
  rig.path = "bodies_rig";
  set_up_camera(rig, image_width_px);
  for (const char* name : {"cube", "pyramid"}) {
    RigObject object;
    object.name = name;
    object.eta_int_over_ext = eta_int_over_ext;
    rig.objects.push_back(object);
  }
  rig.lights = {studio_led("led1", {30, -60, 80}, {-30, 60, -70}),
                studio_led("led2", {-70, -20, 60}, {70, 20, -50})};
  for (const auto& [material, media] : materials) {
    rig.truth_materials[material] = media;
    for (const char* object : {"cube", "pyramid"}) {
      for (const char* number : {"1", "2"}) {
        RigShot shot;
        shot.file = material + "_" + object + "_" + number + ".dng";
        shot.object = object;
        shot.material = material;
        shot.lights = {std::string("led") + number};
        rig.shots.push_back(shot);
      }
    }
  }
  return rig;
}

ObjectScenes bodies_scenes(const Rig& rig) {
  return open_objects(rig, [](const RigObject& object) {
    return object.name == "cube" ? cube_mesh() : pyramid_on_pedestal_mesh();
  });
}

}  // namespace scattermeter::apps
