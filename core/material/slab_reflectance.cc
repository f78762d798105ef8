#include "core/material/slab_reflectance.h"

#include <cmath>
#include <stdexcept>

#include "core/material/fresnel.h"

namespace scattermeter {
namespace {

// 1 - rho_e: 2 times the integral of the transmittance over mu dmu, by the midpoint rule.
double diffuse_transmittance(double eta) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double mu = (i + 0.5) / kSteps;
    sum += fresnel_transmittance(eta, mu) * mu;
  }
  return 2.0 * sum / kSteps;
}

}  // namespace

double slab_reflectance(const Medium& m, double thickness_mm, double background_albedo) {
  if (!(m.sigma_s_prime_per_mm > 0.0) || !(m.sigma_a_per_mm >= 0.0) ||
      !(m.eta_int_over_ext >= 1.0) || !(thickness_mm > 0.0) || !(background_albedo >= 0.0) ||
      !(background_albedo <= 1.0)) {
    throw std::invalid_argument("slab_reflectance: coefficients, eta, thickness or background");
  }
  const double diffusion_mm = 1.0 / (3.0 * m.sigma_t_prime_per_mm());
  const double k = std::sqrt(3.0 * m.sigma_a_per_mm * m.sigma_t_prime_per_mm());
  double r = thickness_mm / (thickness_mm + 4.0 * diffusion_mm);
  double t = 1.0 - r;
  // So thin an absorption that the formula would divide 0 by 0 changes neither.
  if (k * thickness_mm > 1e-6) {
    const double deep = (1.0 - 2.0 * diffusion_mm * k) / (1.0 + 2.0 * diffusion_mm * k);
    const double e = std::exp(-k * thickness_mm);
    r = deep * -std::expm1(-2.0 * k * thickness_mm) / (1.0 - deep * deep * e * e);
    t = (1.0 - deep * deep) * e / (1.0 - deep * deep * e * e);
  }
  const double eta2 = m.eta_int_over_ext * m.eta_int_over_ext;
  const double enters = diffuse_transmittance(m.eta_int_over_ext);
  const double leaves = enters / eta2;
  const double rho_e = 1.0 - enters, rho_i = 1.0 - leaves;
  // Of the lower face with the background behind it, from inside.
  const double below =
      rho_i + enters * background_albedo * leaves / (1.0 - background_albedo * rho_e);
  const double inside = r + t * t * below / (1.0 - r * below);
  return rho_e + enters * leaves * inside / (1.0 - rho_i * inside);
}

}  // namespace scattermeter
