#include "apps/plastics_rig.h"

#include <string>

#include "apps/bodies.h"
#include "apps/studio.h"

namespace scattermeter::apps {
namespace {

std::array<Medium, 3> medium(const std::array<double, 3>& s, const std::array<double, 3>& a) {
  return {Medium{s[0], a[0], 1.0}, Medium{s[1], a[1], 1.0}, Medium{s[2], a[2], 1.0}};
}

}  // namespace

Rig plastics_rig(int image_width_px) {
  Rig rig;
  rig.path = "plastics_rig";
  set_up_camera(rig, image_width_px);
  rig.camera.exposure_s = 0.1;
  for (const char* name : {"cube", "pyramid"}) {
    RigObject object;
    object.name = name;
    object.eta_int_over_ext = 1.49;
    rig.objects.push_back(object);
  }
  rig.lights = {studio_led("led1", {30, -60, 80}, {-30, 60, -70}),
                studio_led("led2", {-70, -20, 60}, {70, 20, -50})};
  for (const char* material : {"PP", "PE", "POM"}) {
    for (const char* object : {"cube", "pyramid"}) {
      for (const char* number : {"1", "2"}) {
        RigShot shot;
        shot.file = std::string(material) + "_" + object + "_" + number + ".dng";
        shot.object = object;
        shot.material = material;
        shot.lights = {std::string("led") + number};
        rig.shots.push_back(shot);
      }
    }
  }
  rig.truth_materials["PP"] = medium({0.62, 0.70, 0.80}, {0.0012, 0.0010, 0.0018});
  rig.truth_materials["PE"] = medium({1.15, 1.32, 1.50}, {0.0016, 0.0013, 0.0026});
  rig.truth_materials["POM"] = medium({2.19, 2.45, 2.70}, {0.0020, 0.0024, 0.0041});
  return rig;
}

ObjectScenes plastics_scenes(const Rig& rig) {
  return open_objects(rig, [](const RigObject& object) {
    return object.name == "cube" ? cube_mesh() : pyramid_on_pedestal_mesh();
  });
}

}  // namespace scattermeter::apps
