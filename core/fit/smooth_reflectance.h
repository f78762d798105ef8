// The diffuse reflectance r(d) without the dipole: non-negative, decreasing, smooth.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/fit/estimate.h"
#include "core/fit/recovered_reflectance.h"

namespace scattermeter {

struct SmoothReflectanceOptions {
  ScalePrior scale;
  // A distance counts as determined if the image alone, all else known, determines r around it to
  // this relative deviation, and the fit's deviation of r there (without the scale's) is as small.
  double max_log_std = 0.3;
  void Check() const;  // std::invalid_argument naming the field
};

// r at one distance.
struct ReflectanceKnot {
  double distance_mm = 0;
  double r_per_mm2 = 0;
  // Standard deviation of log r: noise, nuisances and smoothing bias; `log_std` includes that of
  // the scale (infinite for a free scale), `shape_log_std` does not.
  double log_std = 0;
  double shape_log_std = 0;
  double low95_per_mm2 = 0;   // r exp(-1.96 log_std)
  double high95_per_mm2 = 0;  // r exp(+1.96 log_std)
  // Mean distance over which r is averaged, weighted by the influence of log r there on log r here.
  double spread_mm = 0;
  bool determined = false;
};

struct SmoothReflectance {
  std::vector<ReflectanceKnot> knots;  // by distance, a subset of the DistanceKnots
  Eigen::VectorXd r_per_mm2;        // on all DistanceKnots; extrapolated beyond the determined ones
  double source_depth_mm = 0;       // z0 below
  double smoothing_weight = 0;      // lambda below, its geometric mean
  double effective_parameters = 0;  // trace of the influence of the data on the fit
  double reduced_chi2 = 0;          // of the image, per row not spent on effective parameters
  // Why the curve must not be trusted; empty: it may be trusted wherever it is determined.
  std::vector<std::string> reasons;
};

// log r = f(t), t = log(d^2 + z0^2), a cubic spline that falls everywhere (core/base/log_spline.h),
// so r is positive and decreasing by construction. It minimises
//   |image - W r|^2 / variance + priors of the nuisances
//   + lambda min over c of ∫ (g''' - g''/2)^2 exp(t/2) dt,   g = f - c exp(-t),
// whose last term vanishes for every r = const (d^2 + z0^2)^-p exp(-b sqrt(d^2 + z0^2)) and, to
// first order, for such an r with another depth: more smoothing draws the curve towards this
// family. The fit starts from the family's best member; z0 is chosen, among depths a factor sqrt(2)
// apart, by the best fit.
//
// The spline has three breaks per octave of d^2 + z0^2 throughout. The knots reported are chosen
// among the DistanceKnots by the information of the image: from d = 0 outwards, the next one is
// where the image, all else known, determines the level of r in between to max_log_std, and at
// least a third of an octave farther. The remaining interval, from the last such knot to the
// longest distance, is not reported.
//
// lambda is integrated over, weighted by its marginal likelihood, with r as a draw from the
// Gaussian process whose log prior is the last term (Wahba's generalised maximum likelihood, 1985,
// but its mean instead of its maximum; Laplace's approximation, as f is in an exponent). The single
// best lambda would give error bars that are too short whenever noise makes it large. Preferred to
// generalised cross-validation, which varies more from image to image (95 % bars that covered 66 %
// on the half-lit plate at 10 % noise, against 85 % by maximum likelihood with the same penalty),
// and to the discrepancy principle, which always oversmooths. It also works without noise: lambda
// then reflects the roughness of f itself. The noise is taken as stated, or from the residual if
// that is larger.
//
// Error bars are the posterior deviations of that process. They include the smoothing bias in the
// mean over draws (Wahba 1983): 95 % of the distances lie within 1.96 deviations, possibly fewer
// where f bends most. The bounds are ignored: where they are active, the bars are too wide. A
// nuisance that is not fitted widens them. A non-zero std of the scale adds to them, as log r + log
// scale is what the image shows.
//
// `nuisances`: those of the system from which `recovered` comes. Never throws for valid options and
// matching sizes; what cannot be determined is stated in `reasons`.
SmoothReflectance smooth_reflectance(const RecoveredReflectance& recovered,
                                     const std::vector<Nuisance>& nuisances,
                                     const DistanceKnots& knots,
                                     const SmoothReflectanceOptions& options = {});

}  // namespace scattermeter
