// Diffuse reflectance of a plate of scattering material on a background.
#pragma once

#include "core/material/medium.h"

namespace scattermeter {

// Share of uniform diffuse light that an infinite plate with smooth faces reflects, its surface
// reflection included, lying on a matt background of this albedo with a thin gap of air between.
//
// Fluxes of the diffusion approximation, J+- = phi / 4 -+ (D / 2) phi', D = 1 / (3 sigma_t')
// (Ishimaru, Wave Propagation and Scattering in Random Media, 1978, chapter 9), in a plate of
// thickness L without boundaries:
//   r = r8 (1 - e^2) / (1 - r8^2 e^2),  t = (1 - r8^2) e / (1 - r8^2 e^2),
//   r8 = (1 - 2 D k) / (1 + 2 D k),  k = sqrt(3 sigma_a sigma_t'),  e = exp(-k L),
// for sigma_a = 0 r = L / (L + 4 D), t = 1 - r; then the reflections of diffuse light at the faces
// (Saunderson, J. Opt. Soc. Am. 32, 1942, p. 727), by Fresnel's equations, averaged over the
// hemisphere: from outside rho_e, from inside rho_i = 1 - (1 - rho_e) / eta^2.
// Good for albedos near 1 and plates of several mean free paths: a half-space without faces agrees
// with half_space_albedo() to 0.013 for albedos of at least 0.9.
//
// Domain: sigma_s' > 0, sigma_a >= 0, eta >= 1, thickness > 0, background 0 .. 1; outside
// std::invalid_argument.
double slab_reflectance(const Medium& medium, double thickness_mm, double background_albedo);

}  // namespace scattermeter
