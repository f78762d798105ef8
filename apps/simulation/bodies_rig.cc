#include "apps/simulation/bodies_rig.h"

#include "apps/rig/open_objects.h"
#include "apps/simulation/synthetic_camera.h"
#include "core/mesh/bodies.h"

namespace scattermeter::apps {

Rig bodies_rig(int image_width_px, double eta_int_over_ext,
               const std::vector<NamedMedia>& materials, const std::vector<std::string>& bodies) {
  Rig rig;
  rig.path = "bodies_rig";
  set_up_camera(rig, image_width_px);
  for (const std::string& name : bodies) {
    SceneObject object;
    object.name = name;
    object.eta_int_over_ext = eta_int_over_ext;
    rig.scene.objects.push_back(object);
  }
  rig.scene.lights = {synthetic_led("led1", {30, -60, 80}, {-30, 60, -70}),
                      synthetic_led("led2", {-70, -20, 60}, {70, 20, -50})};
  for (const auto& [material, media] : materials) {
    rig.truth.materials[material] = media;
    for (const std::string& object : bodies) {
      for (const char* number : {"1", "2"}) {
        SceneShot shot;
        shot.file = material + "_" + object + "_" + number + ".dng";
        shot.object = object;
        shot.material = material;
        shot.lights = {std::string("led") + number};
        rig.scene.shots.push_back(shot);
      }
    }
  }
  return rig;
}

ObjectScenes bodies_scenes(const Rig& rig) {
  return open_objects(rig, [](const SceneObject& object) { return body_mesh(object.name); });
}

}  // namespace scattermeter::apps
