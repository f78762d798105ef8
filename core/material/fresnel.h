// Fresnel transmittance and internal reflectance of a smooth dielectric boundary.
#pragma once

namespace scattermeter {

// Power transmittance of unpolarised light that meets the boundary from outside.
// eta_int_over_ext > 0: index of the side behind the boundary over that of the side of incidence.
// cos_theta: cosine between direction and normal on the side of incidence; 0 for cos_theta <= 0.
// Exact Fresnel equations; total reflection (eta < 1) gives 0. Throws std::invalid_argument for eta
// <= 0.
double fresnel_transmittance(double eta_int_over_ext, double cos_theta);

// Mean internal reflectance of diffuse light, F_dr (paper eq. 7; Egan and Hilgeman 1979), a fit in
// eta_int_over_ext with one polynomial above 1 and one below. Within 0.005 of the integral of the
// Fresnel equations for 1 <= eta <= 1.6 (test: quadrature).
double diffuse_internal_reflectance(double eta_int_over_ext);

// A = (1 + F_dr) / (1 - F_dr), the boundary mismatch of the dipole (paper eq. 6).
double boundary_mismatch(double eta_int_over_ext);

}  // namespace scattermeter
