// Does the dipole fit at all?
#pragma once

#include <string>
#include <vector>

#include "core/diffusion/distance_weights.h"
#include "core/fit/estimate.h"
#include "core/fit/linear_shot.h"
#include "core/fit/recovered_reflectance.h"
#include "core/material/medium.h"

namespace scattermeter {

struct DipoleMisfitOptions {
  ScalePrior scale;  // the one of the fit
  // Departures of log r from the dipole that the test looks for: smooth ones of about this size.
  double sought_departure = 0.3;
  void Check() const;  // std::invalid_argument naming the field
};

struct DipoleMisfit {
  double chi2_drop = 0;  // from the best dipole to the free r
  int dof = 0;           // directions in which r is freed
  // Probability of so large a drop where the dipole is true. Exact for normal errors of the stated
  // size; conservative where they are smaller. 1 where no test is possible.
  double p_value = 1;
  // Departure of log r from the dipole that explains the drop: root mean square over the breaks.
  double log_departure = 0;
  std::vector<std::string> reasons;  // why no test is possible; empty: it is
};

// Frees r = dipole * exp(delta): delta is a spline in log(d^2 + z_r^2) of two breaks an octave.
// What a small change of the dipole's own parameters, the scale (within its prior) and every
// nuisance (those that are not fitted as well) can explain is projected out, so that neither
// the fit's last digit nor a bound it rests on matters. Of the rest those independent directions
// are taken in which a departure of the sought size, whose second differences are of that size too,
// would exceed the noise by one standard deviation. They are chosen without looking at the
// residual, so under a true dipole the drop is chi-square with as many degrees of freedom. Where
// the residual that even the free r leaves exceeds the stated noise, the drop is divided by the
// excess. `medium` and `scale`: the best dipole's, as fit_dipole returns; scale = measured over
// predicted.
DipoleMisfit dipole_misfit(const RecoveredReflectance& recovered,
                           const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                           const Medium& medium, double scale,
                           const DipoleMisfitOptions& options = {});

}  // namespace scattermeter
