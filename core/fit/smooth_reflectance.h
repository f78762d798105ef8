// The diffuse reflectance r(d) of the material without the dipole: non-negative, falling, smooth.
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
  // A distance is determined when the image alone, all else known, determines r about it to this
  // relative deviation, and the fit knows r there (scale apart) as well.
  double max_log_std = 0.3;
  void Check() const;  // std::invalid_argument naming the field
};

// r at one distance.
struct ReflectanceKnot {
  double distance_mm = 0;
  double r_per_mm2 = 0;
  // Standard deviation of log r: noise, nuisances and smoothing bias; `log_std` with the scale's
  // (infinite for a free scale), `shape_log_std` without.
  double log_std = 0;
  double shape_log_std = 0;
  double low95_per_mm2 = 0;   // r exp(-1.96 log_std)
  double high95_per_mm2 = 0;  // r exp(+1.96 log_std)
  // Mean distance, weighted by how much log r there counts in log r here, over which r is averaged.
  double spread_mm = 0;
  bool determined = false;
};

struct SmoothReflectance {
  std::vector<ReflectanceKnot> knots;  // by distance, a subset of the DistanceKnots
  Eigen::VectorXd r_per_mm2;           // on all DistanceKnots; beyond what is determined a guess
  double source_depth_mm = 0;          // z0 below
  double smoothing_weight = 0;         // lambda below, its geometric mean
  double effective_parameters = 0;     // trace of the influence of the data on the fit
  double reduced_chi2 = 0;             // of the image, per row not spent on effective parameters
  // Why the curve must not be trusted; empty: it may, wherever it is determined.
  std::vector<std::string> reasons;
};

// log r = f(t), t = log(d^2 + z0^2), a cubic spline that falls everywhere (core/base/log_spline.h),
// so r is positive and decreasing by construction. It minimises
//   |image - W r|^2 / variance + priors of the nuisances
//   + lambda min over c of ∫ (g''' - g''/2)^2 exp(t/2) dt,   g = f - c exp(-t),
// whose last term vanishes for every r = const (d^2 + z0^2)^-p exp(-b sqrt(d^2 + z0^2)) and, to
// first order, for such an r of another depth: the more smoothing, the more like that family. Its
// best member is the start; z0 is the one, of depths a factor sqrt(2) apart, whose best member fits
// best.
//
// The spline has three breaks an octave of d^2 + z0^2 throughout. The knots reported are chosen
// among the DistanceKnots by the information of the image: from d = 0 outwards, the next one is
// where the image, all else known, determines the level of r in between to max_log_std, and at
// least a third of an octave on. What is left beyond the last such knot is one interval, to the
// longest distance, that nothing is said about.
//
// lambda is integrated over, weighted by its marginal likelihood, r seen as a draw from the normal
// process of which the last term is the logarithm (Wahba's generalised maximum likelihood, 1985,
// but its mean instead of its maximum; Laplace's approximation, as f is in an exponent). The
// one best lambda alone has bars that are too short just when noise makes it large. Preferred to
// generalised cross-validation, which swings more from image to image (95 % bars that held 66 % on
// the half-lit plate at 10 % noise, against 85 % by maximum likelihood with the same penalty), and
// to the discrepancy principle, which always oversmooths. It needs no noise: for an image without
// any, lambda settles at the roughness of f itself. The noise is as stated, or what the residual
// states where that is more.
//
// Error bars are the posterior deviations of that process. They hold the smoothing bias, as the
// mean over draws (Wahba 1983): 95 % of the distances lie within 1.96 deviations, though where f
// bends most it may be fewer. The bounds are not
// counted: where they hold, the bars are too wide. A nuisance that is not fitted widens them. A
// non-zero std of the scale adds to them, as log r + log scale is what the image shows.
//
// `nuisances`: those of the system that `recovered` comes from. Never throws for valid options and
// fitting sizes; what cannot be determined is stated in `reasons`.
SmoothReflectance smooth_reflectance(const RecoveredReflectance& recovered,
                                     const std::vector<Nuisance>& nuisances,
                                     const DistanceKnots& knots,
                                     const SmoothReflectanceOptions& options = {});

}  // namespace scattermeter
