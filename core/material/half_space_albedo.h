// What a half-space of scattering material sends back of the light that falls on it.
#pragma once

namespace scattermeter {

// Share of diffuse light (Lambertian, over the hemisphere) that a half-space of isotropic
// scatterers of this single-scattering albedo (sigma_s / sigma_t) sends back, its boundary
// index-matched:
//   1 - 2 sqrt(1 - albedo) integral over 0 .. 1 of H(mu) mu dmu
// with Chandrasekhar's H (Radiative Transfer, 1950, chapter V), solved to 1e-8 (test: against his
// tables). It is what renderers mean by the colour of a subsurface material. Domain: 0 .. 1;
// std::invalid_argument outside.
double half_space_albedo(double single_scattering_albedo);

// The same of parallel light that comes in at this cosine to the normal, 0 < cosine <= 1:
// 1 - sqrt(1 - albedo) H(cosine).
double half_space_albedo(double single_scattering_albedo, double cos_incidence);

}  // namespace scattermeter
