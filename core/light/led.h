// An LED as a point source with a lobe.
#pragma once

#include <memory>

#include <Eigen/Core>

#include "core/light/led_lobe.h"

namespace scattermeter {

// Radiant intensity toward the unit direction w (away from the LED) per channel:
// intensity_W_per_sr * max(0, axis . w)^exponent, times the table's value where there is a table.
// Exponent 1 is a Lambertian chip, 0 is uniform over the hemisphere in front; with a table it is a
// correction to it, 0 for the table as it stands.
struct Led {
  Eigen::Vector3d position_mm = Eigen::Vector3d::Zero();  // world
  Eigen::Vector3d axis = -Eigen::Vector3d::UnitZ();  // world, unit length, direction of emission
  double exponent = 1;                               // >= 0
  double radius_mm = 0;  // of a disc perpendicular to the axis, of uniform radiance; 0: a point
  Eigen::Array3d intensity_W_per_sr = Eigen::Array3d::Ones();  // R, G, B, where the lobe is 1

  std::shared_ptr<const LobeTable> table;  // null: the cosine power alone

  // The lobe, dimensionless: max(0, axis . w)^exponent, times the table's value.
  double lobe(const Eigen::Vector3d& unit_direction) const;

  // The least exponent that a calibration may find: a table may turn out too narrow.
  double least_exponent() const { return table ? -1.0 : 0.0; }

  // Irradiance at a point with the given unit normal, per unit of on-axis intensity, behind the
  // boundary: lobe * cos / r^2 * Ft(eta, cos), in sr/mm^2. eta 1: the irradiance outside. The LED
  // counts as a point at its position, whatever its radius (for discs see core/light/disc_light.h);
  // shadows are ignored. 0 on the far side of the surface.
  double transmitted_irradiance_per_mm2(const Eigen::Vector3d& point_mm,
                                        const Eigen::Vector3d& normal,
                                        double eta_int_over_ext) const;
};

}  // namespace scattermeter
