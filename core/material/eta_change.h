// What the refractive index changes at a smooth dielectric boundary, relative and per unit of eta.
#pragma once

namespace scattermeter {

// Changes are divided differences over this step of eta, upwards: by total reflection, the
// reflectance has no derivative at the critical angle.
inline constexpr double kEtaStep = 0.01;

// Of Fresnel's transmittance (passed) or reflectance of unpolarised light that meets the boundary
// from outside or from inside. cos_theta: on the side of incidence. Domain: eta_int_over_ext >= 1.
// 0 where nothing passes, or is reflected.
double fresnel_growth(double eta_int_over_ext, bool from_outside, double cos_theta, bool passed);

// The same of a rough boundary, about. Facets that are tilted at random see nearly diffuse light
// from inside, on either side of the critical angle, of which 1 - F_dr passes; light from outside
// is as at a smooth boundary. cos_theta: of the way back; negative from inside.
double rough_growth(double eta_int_over_ext, double cos_theta, bool passed);

// Of l = pi L_o / Ft for the same radiance L_o outside. cos_theta > 0: to the viewer. step: of eta,
// not 0.
double observed_growth(double eta_int_over_ext, double cos_theta, double step = kEtaStep);

// Of the density, over the depth below a plane surface, at which light that enters is scattered
// first, or light that leaves last: sigma_t / mu exp(-optical_length), as the cosine mu inside
// changes with the direction outside given. cos_inside: mu > 0.
double depth_growth(double eta_int_over_ext, double cos_inside, double optical_length);

// Whether light that entered by refraction may have this cosine inside.
bool is_refracted(double eta_int_over_ext, double cos_inside);

// Of light that enters from a given direction; 0 unless is_refracted().
double entry_growth(double eta_int_over_ext, double cos_inside);

// Of light that flies so far from its last scattering and leaves in a given direction, but for the
// share that passes: the solid angle inside (1/eta^2) and depth_growth(). Where light falls outside
// the body depends on the direction outside, which a given one inside does not hold: at the
// critical angle, it changes without limit.
double exit_growth(double eta_int_over_ext, double cos_inside, double optical_length);

}  // namespace scattermeter
