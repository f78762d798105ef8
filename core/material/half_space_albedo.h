// Albedo (diffuse reflectance) of a half-space of scattering material.
#pragma once

namespace scattermeter {

// Share of diffuse incident light (Lambertian, over the hemisphere) reflected by an index-matched
// half-space of isotropic scatterers with this single-scattering albedo (sigma_s / sigma_t):
//   1 - 2 sqrt(1 - albedo) integral over 0 .. 1 of H(mu) mu dmu
// with Chandrasekhar's H (Radiative Transfer, 1950, chapter V), solved to 1e-8 (test: against his
// tables). Renderers call it the colour of a subsurface material. Domain: 0 .. 1;
// std::invalid_argument outside.
double half_space_albedo(double single_scattering_albedo);

// The same for collimated light with this cosine of incidence, 0 < cosine <= 1:
// 1 - sqrt(1 - albedo) H(cosine).
double half_space_albedo(double single_scattering_albedo, double cos_incidence);

}  // namespace scattermeter
