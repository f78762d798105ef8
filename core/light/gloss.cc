#include "core/light/gloss.h"

#include <numbers>

namespace scattermeter {

double gloss_per_mm2(const RoughBoundary& boundary, const RayScene& scene, const Led& led,
                     const Eigen::Vector3d& at_mm, const Eigen::Vector3d& normal,
                     const Eigen::Vector3d& camera_mm) {
  const Eigen::Vector3d to_camera = (camera_mm - at_mm).normalized();
  const double irradiance = led.transmitted_irradiance_per_mm2(at_mm, normal, 1.0);
  const double per_sr =
      boundary.reflection_per_sr((led.position_mm - at_mm).normalized(), to_camera, normal);
  if (!(irradiance * per_sr > 0.0) || scene.occluded(at_mm, normal, led.position_mm)) return 0.0;
  return std::numbers::pi * per_sr * irradiance /
         boundary.smooth_transmittance(to_camera.dot(normal));
}

}  // namespace scattermeter
