// The dipole that explains the recovered reflectance.
#pragma once

#include "core/distance_weights.h"
#include "core/estimate.h"
#include "core/linear_shot.h"

namespace scattermeter {

struct DipoleFitOptions {
  double eta_int_over_ext = 1.3;
  ScalePrior scale;
  // Verdict limits.
  std::size_t min_rows = 20;
  double max_relative_std_sigma_s = 0.5;
  // The dipole is refused when its residual is significant and large: reduced chi-square above the
  // first and relative rms above the second.
  double max_reduced_chi2 = 4.0;
  double max_rms_relative = 0.01;
  void Check() const;  // std::invalid_argument naming the field
};

// Least squares of s R(d; sigma_s', sigma_a) against the recovered r in the metric of r's own
// errors, which is the image's chi-square; s is the scale with its prior. Continuous in all
// parameters (Ceres, analytic derivatives), in (log sigma_t', 1 - alpha', log s), with 0 <= 1 -
// alpha' <= 0.95. Started from the best of a coarse set over all magnitudes that the knots can
// resolve, so no guess is asked for. Standard deviations from the Jacobian at the optimum, widened
// by sqrt(reduced chi-square) where that exceeds 1; intervals are +-1.96 std, cut at 0. The answer
// carries its reasons for refusal: too few rows, not converged, a mean free path outside what the
// knots resolve, an undetermined sigma_s', a residual the dipole cannot explain.
Estimate fit_dipole(const DenseSystem& system, const DistanceKnots& knots,
                    const DipoleFitOptions& options);

}  // namespace scattermeter
