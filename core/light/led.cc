#include "core/light/led.h"

#include <cmath>

#include "core/material/fresnel.h"

namespace scattermeter {

double Led::lobe(const Eigen::Vector3d& unit_direction) const {
  const double c = axis.dot(unit_direction);
  if (!(c > 0.0)) return 0.0;
  const double power = exponent == 0.0 ? 1.0 : std::pow(c, exponent);
  return table ? power * table->value<double>(axis, unit_direction) : power;
}

double Led::transmitted_irradiance_per_mm2(const Eigen::Vector3d& point_mm,
                                           const Eigen::Vector3d& normal,
                                           double eta_int_over_ext) const {
  const Eigen::Vector3d to_led_mm = position_mm - point_mm;
  const double r2 = to_led_mm.squaredNorm();
  const Eigen::Vector3d w = to_led_mm / std::sqrt(r2);
  const double cos_theta = normal.dot(w);
  if (!(cos_theta > 0.0)) return 0.0;
  return lobe(-w) * cos_theta / r2 * fresnel_transmittance(eta_int_over_ext, cos_theta);
}

}  // namespace scattermeter
