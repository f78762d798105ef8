// A homogeneous scattering medium with a phase function and its boundary, for path tracing.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/material/medium.h"
#include "core/material/phase_function.h"
#include "core/material/rough_boundary.h"

namespace scattermeter {

// Domain: sigma_s > 0, sigma_a >= 0, eta_int_over_ext >= 1 (a body not optically thinner than its
// surroundings), surface_alpha 0 (smooth) .. RoughBoundary::kMostAlpha.
struct ScatteringMedium {
  double sigma_s_per_mm = 1;
  double sigma_a_per_mm = 0;
  PhaseFunction phase = {};
  double eta_int_over_ext = 1;
  double surface_alpha = 0;  // roughness of the boundary (RoughBoundary)

  double sigma_t_per_mm() const { return sigma_s_per_mm + sigma_a_per_mm; }
  double albedo() const { return sigma_s_per_mm / sigma_t_per_mm(); }

  // Throws std::invalid_argument outside the domain.
  void check() const {
    phase.check();
    if (!(sigma_s_per_mm > 0.0 && sigma_a_per_mm >= 0.0 && eta_int_over_ext >= 1.0 &&
          surface_alpha >= 0.0 && surface_alpha <= RoughBoundary::kMostAlpha &&
          std::isfinite(sigma_t_per_mm() * eta_int_over_ext))) {
      throw std::invalid_argument("ScatteringMedium: sigma_s = " + std::to_string(sigma_s_per_mm) +
                                  ", sigma_a = " + std::to_string(sigma_a_per_mm) +
                                  ", eta = " + std::to_string(eta_int_over_ext) +
                                  ", alpha = " + std::to_string(surface_alpha));
    }
  }
};

// The medium with this phase function and the reduced coefficients of `medium`.
inline ScatteringMedium scattering_medium(const Medium& medium, const PhaseFunction& phase = {},
                                          double surface_alpha = 0.0) {
  return {medium.sigma_s_prime_per_mm / (1.0 - phase.mean_cosine()), medium.sigma_a_per_mm, phase,
          medium.eta_int_over_ext, surface_alpha};
}

}  // namespace scattermeter
