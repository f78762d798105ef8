// An LED as a disc of finite radius.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "core/light/led.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

// A disc of radius_mm about the LED's position, perpendicular to its axis: every part of it emits
// with the LED's lobe and its share of the intensity.
class DiscLight {
 public:
  // Throws std::invalid_argument unless radius_mm > 0. The scene must outlive the object.
  DiscLight(const Led& led, const RayScene& scene, double eta_int_over_ext);

  // Led::transmitted_irradiance_per_mm2, as a mean over the disc. Relative error below 1e-6 where
  // the whole disc is in front of the surface and is farther away than its radius; else 1e-3.
  double open_per_mm2(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal) const;
  // Share of that irradiance which the mesh does not block, 0 .. 1; exactly 1 or 0 where all probes
  // agree. Error in a penumbra below 0.005. Adds the number of rays cast to `rays`.
  double visible_share(const Eigen::Vector3d& point_mm, const Eigen::Vector3d& normal,
                       std::size_t& rays) const;

  // The point of the disc for coordinates 0 .. 1 of the unit square; the map preserves ratios of
  // areas (Shirley and Chiu 1997, concentric map).
  Eigen::Vector3d disc_point_mm(double u, double v) const;

 private:
  friend struct DiscEmitter;
  double from_per_mm2(const Eigen::Vector3d& source_mm, const Eigen::Vector3d& point_mm,
                      const Eigen::Vector3d& normal) const;
  Led led_;
  const RayScene& scene_;
  double eta_;
  Eigen::Vector3d across_mm_[2];  // two perpendicular radii
};

}  // namespace scattermeter
