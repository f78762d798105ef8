#include "apps/simulation/plastics_rig.h"

#include <array>

#include "apps/simulation/bodies_rig.h"

namespace scattermeter::apps {
namespace {

std::array<Medium, 3> medium(const std::array<double, 3>& s, const std::array<double, 3>& a) {
  return {Medium{s[0], a[0], 1.0}, Medium{s[1], a[1], 1.0}, Medium{s[2], a[2], 1.0}};
}

}  // namespace

Rig plastics_rig(int image_width_px) {
  Rig rig = bodies_rig(image_width_px, 1.49,
                       {{"PP", medium({0.62, 0.70, 0.80}, {0.0012, 0.0010, 0.0018})},
                        {"PE", medium({1.15, 1.32, 1.50}, {0.0016, 0.0013, 0.0026})},
                        {"POM", medium({2.19, 2.45, 2.70}, {0.0020, 0.0024, 0.0041})}});
  rig.path = "plastics_rig";
  rig.scene.camera.exposure_s = 0.085;
  return rig;
}

}  // namespace scattermeter::apps
