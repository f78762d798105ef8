#include "core/material/eta_change.h"

#include <algorithm>
#include <cmath>

#include "core/material/fresnel.h"

namespace scattermeter {

namespace {

// Of share(eta), where there is any.
template <class Share>
double growth(const Share& share, double eta, double step = kEtaStep) {
  const double now = share(eta);
  return now > 0.0 ? (share(eta + step) / now - 1.0) / step : 0.0;
}

double sin2_outside(double eta, double cos_inside) {
  return eta * eta * (1.0 - cos_inside * cos_inside);
}

}  // namespace

double fresnel_growth(double eta_int_over_ext, bool from_outside, double cos_theta, bool passed) {
  return growth(
      [&](double eta) {
        const double t = fresnel_transmittance(from_outside ? eta : 1.0 / eta, cos_theta);
        return passed ? t : 1.0 - t;
      },
      eta_int_over_ext);
}

double rough_growth(double eta_int_over_ext, double cos_theta, bool passed) {
  if (cos_theta > 0.0) {
    constexpr double kLeastCosine = 0.05;  // lower ones meet facets that lean towards them
    return fresnel_growth(eta_int_over_ext, true, std::max(kLeastCosine, cos_theta), passed);
  }
  return growth(
      [&](double eta) {
        const double r = diffuse_internal_reflectance(eta);
        return passed ? 1.0 - r : r;
      },
      eta_int_over_ext);
}

double observed_growth(double eta_int_over_ext, double cos_theta, double step) {
  return growth([&](double eta) { return 1.0 / fresnel_transmittance(eta, cos_theta); },
                eta_int_over_ext, step);
}

double depth_growth(double eta_int_over_ext, double cos_inside, double optical_length) {
  const double cos2 = cos_inside * cos_inside;
  return (1.0 - cos2) / (eta_int_over_ext * cos2) * (optical_length - 1.0);
}

bool is_refracted(double eta_int_over_ext, double cos_inside) {
  return cos_inside > 0.0 && sin2_outside(eta_int_over_ext, cos_inside) < 1.0;
}

double entry_growth(double eta_int_over_ext, double cos_inside) {
  if (!is_refracted(eta_int_over_ext, cos_inside)) return 0.0;
  const double cos_outside = std::sqrt(1.0 - sin2_outside(eta_int_over_ext, cos_inside));
  return fresnel_growth(eta_int_over_ext, true, cos_outside, true);
}

double exit_growth(double eta_int_over_ext, double cos_inside, double optical_length) {
  return depth_growth(eta_int_over_ext, cos_inside, optical_length) - 2.0 / eta_int_over_ext;
}

}  // namespace scattermeter
