// A test of whether the dipole fits an image.
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
  ScalePrior scale;  // as in the fit
  // The test looks for smooth departures of log r from the dipole of about this size.
  double sought_departure = 0.3;
  void Check() const;  // std::invalid_argument naming the field
};

struct DipoleMisfit {
  double chi2_drop = 0;  // from the best dipole to the free r
  int dof = 0;           // number of directions in which r is free
  // Probability of so large a drop where the dipole is true. Exact for normal errors of the stated
  // size; conservative where they are smaller. 1 where no test is possible.
  double p_value = 1;
  // The departure of log r from the dipole that explains the drop: root mean square over the
  // breaks.
  double log_departure = 0;
  std::vector<std::string> reasons;  // why no test is possible; empty: it is possible
};

// Frees r = dipole * exp(delta): delta is a spline in log(d^2 + z_r^2) of two breaks an octave.
// What a small change of the dipole's own parameters, the scale (within its prior) and every
// nuisance (those that are not fitted as well) can explain is projected out, so that neither the
// fit's last digit nor an active bound matters. Of the rest, the test uses those independent
// directions in which a departure of the sought size, whose second differences are of that size
// too, would exceed the noise by one standard deviation. They are chosen without looking at the
// residual, so under a true dipole the drop is chi-square with as many degrees of freedom. Where
// the residual left even by the free r exceeds the stated noise, the drop is divided by the excess.
// `medium` and `scale`: the best dipole's, as fit_dipole returns; scale = measured over predicted.
DipoleMisfit dipole_misfit(const RecoveredReflectance& recovered,
                           const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                           const Medium& medium, double scale,
                           const DipoleMisfitOptions& options = {});

}  // namespace scattermeter
