// What the phase function changes in the reflectance of a half-space.
#pragma once

#include "core/material/medium.h"

namespace scattermeter {

// For light at right angles, per unit of gamma (PhaseFunction::gamma()) at the same sigma_s', with
// l' = 1 / sigma_t' the transport mean free path. structure_mm >= 0: finer structure of the kernels
// is smoothed away, with the same integrals.

// Change of R(d), 1/mm^2: light that scatters forward leaves farther from its entry, a share of it
// from within l'/2 to one to three l', so that without absorption the integral over the plane is 0.
// Fitted to paths of the tracer (test: to 0.01 of the light within any radius, for eta 1.3 to 1.5
// and albedos alpha' of 0.9 and more).
double phase_effect_per_mm2(const Medium& medium, double distance_mm, double structure_mm = 0.0);

// The kernel by which that light leaves, 1/mm^2, with an integral of 1: the reach of the last and
// first scatterings.
double near_entry_per_mm2(const Medium& medium, double distance_mm, double structure_mm = 0.0);

// Light that enters at an angle keeps some of its direction along the surface: the radiance that
// leaves towards the camera changes by this factor times the light that entered nearby (W/mm^2 over
// pi) times -l_t . c_t, the parts along the surface of the unit vectors to light and camera (test:
// core/estimation/phase_nuisance.h against paths).
double phase_turn(double eta_int_over_ext);

}  // namespace scattermeter
