// The power law with an exponential tail that fits the recovered reflectance best.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/fit/marginal_information.h"

namespace scattermeter {

// r = const (d^2 + z0^2)^-p exp(-b sqrt(d^2 + z0^2)), p >= 0, b >= 0.
struct ReflectancePilot {
  double source_depth_mm = 0;  // z0
  Eigen::VectorXd log_r;       // log of r in 1/mm^2, on the knots
  double chi2 = 0;             // without the floor
};

// Least squares over const, p, b and over z0 from the resolution to the longest distance in steps
// of sqrt(2). `nominal` is the image with every nuisance at 0 (its `held` is not used): each fit
// starts with it, because where a nuisance resembles the level of r, the chi-square of `image`
// hardly determines the level, and Gauss-Newton from a poor shape would diverge along it. Empty: no
// positive r explains any of the image.
std::optional<ReflectancePilot> reflectance_pilot(const MarginalInformation& nominal,
                                                  const MarginalInformation& image,
                                                  const DistanceKnots& knots);

// log(d^2 + z0^2) on the knots.
Eigen::VectorXd log_squared_depth(const DistanceKnots& knots, double source_depth_mm);

}  // namespace scattermeter
