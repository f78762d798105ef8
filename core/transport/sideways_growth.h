// Light that a change of the refractive index moves along the surface.
#pragma once

#include <Eigen/Core>

#include "core/light/entry_source.h"
#include "core/transport/path_boundary.h"

namespace scattermeter {

// Light scattered at a given point entered, and leaves for the camera, where refraction lets it
// pass the surface; a larger index moves that towards the point's foot. What a region of the
// surface has changes by what comes over its border and goes over it, which is as dense as the
// light just within (Reynolds' transport theorem). Growth is relative, and per unit of eta.

// Of the light of a region by a point of it: gained where the point was still beyond the border a
// step of eta ago, lost where it will be. holds(x): whether the region holds a point of its plane.
template <class Holds>
double sideways_growth(const Eigen::Vector3d& x_mm, const Eigen::Vector3d& moved_mm_per_eta,
                       const Holds& holds) {
  // Light changes little over what this moves it by, a tenth of a mean free path or so.
  constexpr double kStep = 0.3;
  const double gained = holds(x_mm - kStep * moved_mm_per_eta) ? 0.0 : 1.0;
  const double lost = holds(x_mm + kStep * moved_mm_per_eta) ? 0.0 : 1.0;
  return (gained - lost) / kStep;
}

// Of light that enters through a face and flies so far to its first scattering. 0 for bodies of
// many facets: where these meet smoothly, what one gains another loses.
double entry_sideways_growth(const PathBoundary& boundary, const Entry& entry,
                             double eta_int_over_ext, double flown_mm);

}  // namespace scattermeter
