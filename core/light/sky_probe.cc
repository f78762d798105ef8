#include "core/light/sky_probe.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

const Eigen::Array3d kZenith(0.45, 1.0, 2.1);
const Eigen::Array3d kHorizon(2.6, 3.0, 3.4);
const Eigen::Array3d kGround(0.7, 0.6, 0.45);
const Eigen::Array3d kSun(1.1, 1.0, 0.85);  // of its radiance
constexpr int kSide = 4;                    // parts of a pixel across, for sky and horizon
constexpr int kSunSide = 16;                // near the sun

Eigen::Array3d background(double z) {
  if (z < 0.0) return kGround;
  // Brightens towards the horizon like the length of the way through the air, levelled off.
  const double haze = std::pow(1.0 - z, 4.0);
  return kZenith + haze * (kHorizon - kZenith);
}

}  // namespace

Environment make_sky_probe(const SkyProbe& sky) {
  const double length = sky.sun_direction.norm();
  if (sky.width_px < 16 || sky.width_px % 2 != 0 || !(sky.sun_direction.z() > 0.0) ||
      !std::isfinite(length) || !(sky.sun_radius_rad > 0.0) || !(sky.sun_radiance >= 0.0)) {
    std::ostringstream message;
    message << "make_sky_probe: width " << sky.width_px << " px, sun towards "
            << sky.sun_direction.transpose() << ", radius " << sky.sun_radius_rad
            << " rad, radiance " << sky.sun_radiance;
    throw std::invalid_argument(message.str());
  }
  const Eigen::Vector3d sun = sky.sun_direction / length;
  Environment probe;
  probe.width_px = sky.width_px;
  probe.height_px = sky.width_px / 2;
  const ProbeMap map(ProbeProjection::kEquirectangular, probe.width_px, probe.height_px);
  const double pixel_rad = 2.0 * std::numbers::pi / sky.width_px;
  for (int y = 0; y < probe.height_px; ++y) {
    for (int x = 0; x < probe.width_px; ++x) {
      const Eigen::Vector3d center = map.direction(x + 0.5, y + 0.5);
      const bool near_sun =
          center.cross(sun).norm() < sky.sun_radius_rad + pixel_rad && center.dot(sun) > 0.0;
      const int side = near_sun ? kSunSide : kSide;
      Eigen::Array3d sum = Eigen::Array3d::Zero();
      double weight = 0.0;
      for (int i = 0; i < side; ++i) {
        // Parts of a row by their solid angle.
        const double yy = y + (i + 0.5) / side;
        const double w =
            map.solid_angle_sr({0.0, y + static_cast<double>(i) / side, 1.0, y + (i + 1.0) / side});
        for (int j = 0; j < side; ++j) {
          const Eigen::Vector3d d = map.direction(x + (j + 0.5) / side, yy);
          Eigen::Array3d radiance = background(d.z());
          if (near_sun && std::atan2(d.cross(sun).norm(), d.dot(sun)) < sky.sun_radius_rad) {
            radiance += sky.sun_radiance * kSun;
          }
          sum += w * radiance;
          weight += w;
        }
      }
      for (int c = 0; c < 3; ++c) probe.radiance.push_back(static_cast<float>(sum[c] / weight));
    }
  }
  return probe;
}

}  // namespace scattermeter
