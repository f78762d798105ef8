// Conversion between single-scattering albedo and the colour that renderers use instead.
#pragma once

#include <string>

namespace scattermeter {

// A renderer takes the diffuse reflectance of a thick body as the colour and derives the albedo
// (sigma_s / sigma_t, isotropic scattering) from it with a fit of its own. Exported is the colour
// from which this fit recovers the measured albedo, so that the error of the fit affects only the
// colour, not the material.
struct ColourFit {
  std::string source;
  double (*albedo_of)(double colour);  // 0 .. 1 -> 0 .. 1, as in the renderer
  double (*colour_of)(double albedo);  // its inverse; 0 .. 1 -> 0 .. 1
};

// Van de Hulst's approximation, colour = (1 - s)(1 - 0.139 s) / (1 + 1.17 s), s = sqrt(1 - albedo):
// van de Hulst, Multiple Light Scattering (1980); Kulla and Conty, Revisiting Physically Based
// Shading at Imageworks (2017); the OpenPBR specification 1.1, section Subsurface. Within 0.0021 of
// half_space_albedo() (test).
const ColourFit& openpbr_colour();

// The fit of Blender's Cycles (intern/cycles/kernel/integrator/subsurface_random_walk.h, Blender
// 2.93 to 4.x), for g = 0. Its albedo is limited to 0.999999. Within 0.006 of half_space_albedo()
// up to an albedo of 0.95, but darker by 0.010 at 0.99, 0.034 at 0.999 and 0.062 at 0.9999 (test).
const ColourFit& cycles_colour();

// colour_of(albedo) - half_space_albedo(albedo): the error of the fit.
double colour_error(const ColourFit& fit, double albedo);

// Ratio of Cycles' radius to 1 / sigma_t', 4 pi in its random walk
// (intern/cycles/kernel/closure/bssrdf.h, bssrdf_setup_radius, of the method Random Walk in Blender
// 4.0 and later).
double cycles_radius_over_mean_free_path();

}  // namespace scattermeter
