#include "core/light/environment.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace scattermeter {

Eigen::Array3f Environment::radiance_toward(const Eigen::Vector3d& direction_in_world) const {
  const ProbeMap map(projection, width_px, height_px);
  const Eigen::Vector2d pixel = map.position_px(world_from_probe.conjugate() * direction_in_world);
  const int x = std::clamp(static_cast<int>(std::floor(pixel.x())), 0, width_px - 1);
  const int y = std::clamp(static_cast<int>(std::floor(pixel.y())), 0, height_px - 1);
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                              static_cast<std::size_t>(x));
  return {radiance[at], radiance[at + 1], radiance[at + 2]};
}

Eigen::Quaterniond world_from_probe(const Eigen::Vector3d& forward, const Eigen::Vector3d& up) {
  const Eigen::Vector3d y = forward.normalized();
  const Eigen::Vector3d right = y.cross(up);
  if (!(right.norm() > 1e-9 * up.norm())) {
    std::ostringstream message;
    message << "world_from_probe: forward " << forward.transpose() << ", up " << up.transpose();
    throw std::invalid_argument(message.str());
  }
  const Eigen::Vector3d x = right.normalized();
  Eigen::Matrix3d rotation;
  rotation << x, y, x.cross(y);
  return Eigen::Quaterniond(rotation).normalized();
}

std::string probe_problem(int width_px, int height_px, const std::vector<float>& radiance) {
  if (width_px < 1 || height_px < 1) {
    return "the probe is " + std::to_string(width_px) + " x " + std::to_string(height_px) +
           " pixels";
  }
  const std::size_t values =
      3 * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  if (radiance.size() != values) {
    return "the probe has " + std::to_string(radiance.size()) + " values, not " +
           std::to_string(values);
  }
  bool any = false;
  for (std::size_t i = 0; i < values; ++i) {
    const float v = radiance[i];
    if (!(v >= 0.0F) || !std::isfinite(v)) {
      const std::size_t pixel = i / 3;
      std::ostringstream message;
      message << "pixel (" << pixel % static_cast<std::size_t>(width_px) << ", "
              << pixel / static_cast<std::size_t>(width_px) << "), channel "
              << "RGB"[i % 3] << ": radiance is " << v << ", must be finite and not negative";
      return message.str();
    }
    any = any || v > 0.0F;
  }
  return any ? "" : "the probe is black";
}

}  // namespace scattermeter
