#include "core/material/fresnel.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace scattermeter {

double fresnel_transmittance(double eta_int_over_ext, double cos_theta) {
  if (!(eta_int_over_ext > 0.0)) {
    throw std::invalid_argument("fresnel_transmittance: eta_int_over_ext = " +
                                std::to_string(eta_int_over_ext));
  }
  if (!(cos_theta > 0.0)) return 0.0;
  const double cos_i = std::fmin(cos_theta, 1.0);
  // Snell: sin_t = sin_i / eta.
  const double sin2_t = (1.0 - cos_i * cos_i) / (eta_int_over_ext * eta_int_over_ext);
  if (sin2_t >= 1.0) return 0.0;
  const double cos_t = std::sqrt(1.0 - sin2_t);
  const double s = (cos_i - eta_int_over_ext * cos_t) / (cos_i + eta_int_over_ext * cos_t);
  const double p = (eta_int_over_ext * cos_i - cos_t) / (eta_int_over_ext * cos_i + cos_t);
  return 1.0 - 0.5 * (s * s + p * p);
}

double diffuse_internal_reflectance(double eta_int_over_ext) {
  const double eta = eta_int_over_ext;
  if (eta >= 1.0) return -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
  return -0.4399 + 0.7099 / eta - 0.3319 / (eta * eta) + 0.0636 / (eta * eta * eta);
}

double boundary_mismatch(double eta_int_over_ext) {
  const double f_dr = diffuse_internal_reflectance(eta_int_over_ext);
  return (1.0 + f_dr) / (1.0 - f_dr);
}

}  // namespace scattermeter
