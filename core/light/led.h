// An LED as a point source with a cosine-power lobe.
#pragma once

#include <Eigen/Core>

namespace scattermeter {

// Radiant intensity toward the unit direction w (away from
// the LED) per channel: intensity_W_per_sr * max(0, axis . w)^exponent. Exponent 1 is a Lambertian
// chip, 0 is uniform over the hemisphere in front.
struct Led {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d axis = -Eigen::Vector3d::UnitZ();  // world, unit length, direction of emission
  double exponent = 1;                               // >= 0
  double radius_mm = 0;  // of a disc perpendicular to the axis, of uniform radiance; 0: a point
  Eigen::Array3d intensity_W_per_sr = Eigen::Array3d::Ones();  // R, G, B, on the axis

  // The lobe, max(0, axis . w)^exponent, dimensionless.
  double lobe(const Eigen::Vector3d& unit_direction) const;

  // Irradiance at a point with the given unit normal, per unit of on-axis intensity, behind the
  // boundary: lobe * cos / r^2 * Ft(eta, cos), in sr/mm^2. eta 1: the irradiance outside. The LED
  // counts as a point at its position, whatever its radius (for discs see core/light/disc_light.h);
  // shadows are ignored. 0 on the far side of the surface.
  double transmitted_irradiance_per_mm2(const Eigen::Vector3d& point_mm,
                                        const Eigen::Vector3d& normal,
                                        double eta_int_over_ext) const;
};

}  // namespace scattermeter
