// A path of light while it is traced.
#pragma once

#include <Eigen/Core>

#include "core/material/eta_change.h"
#include "core/transport/path_score.h"

namespace scattermeter {

struct LightPath {
  Eigen::Vector3d x;
  Eigen::Vector3d direction;  // of flight
  double weight;
  int scatterings = 0;
  double length_mm = 0.0;        // up to the end of the current step
  double per_eta = 0.0;          // as in PathScore
  double per_eta_outside = 0.0;  // the same of what met the surface since it left
  double flown_from_mm = 0.0;    // length at the last scattering or entry
  double cos_entered = 0.0;      // inside, of light refracted in and not yet scattered; else 0
  bool straight = false;         // as in PathScore
  bool by_plane = false;
  bool by_several = false;  // as it last met the surface

  // The next three note what happens to it, for its changes by eta. It is refracted into the body
  // (or enters in a direction that no refracted ray has, as a beam may).
  void enter(double eta, double cos_inside) {
    flown_from_mm = length_mm;
    cos_entered = is_refracted(eta, cos_inside) ? cos_inside : 0.0;
  }
  // It is scattered at the end of its step.
  void end_flight(double eta, double mean_free_path_mm) {
    if (cos_entered > 0.0) {
      per_eta += depth_growth(eta, cos_entered, (length_mm - flown_from_mm) / mean_free_path_mm);
    }
    cos_entered = 0.0;
    flown_from_mm = length_mm;
  }
  // It is refracted out of the body, so far before the end of its step. If it was not scattered
  // inside, its direction there is that of its entry.
  void leave(double eta, double cos_inside, double cos_outside, double before_end_mm,
             double mean_free_path_mm) {
    per_eta_outside += fresnel_growth(eta, true, cos_outside, true);
    if (!(cos_entered > 0.0)) {
      const double flown_mm = length_mm - before_end_mm - flown_from_mm;
      per_eta_outside += exit_growth(eta, cos_inside, flown_mm / mean_free_path_mm);
    }
    cos_entered = 0.0;
  }

  // If it ended there, at one of the body's facets or on the plane (-1).
  PathScore score_at(const Eigen::Vector3d& point_mm, int facet_idx) const {
    return {point_mm,  direction, facet_idx, weight,   scatterings,
            length_mm, per_eta,   straight,  by_plane, by_several};
  }
};

}  // namespace scattermeter
