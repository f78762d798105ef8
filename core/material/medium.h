// A homogeneous scattering medium in the diffusion limit.
#pragma once

namespace scattermeter {

// One colour channel of a homogeneous, isotropically scattering (or similarity-reduced) material.
struct Medium {
  double sigma_s_prime_per_mm = 0;  // reduced scattering coefficient sigma_s (1 - g), >= 0
  double sigma_a_per_mm = 0;        // absorption coefficient, >= 0
  double eta_int_over_ext = 1;      // refractive index inside over outside

  double sigma_t_prime_per_mm() const { return sigma_s_prime_per_mm + sigma_a_per_mm; }
};

}  // namespace scattermeter
