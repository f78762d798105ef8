// Errors of the forward model itself.
#pragma once

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/fit/linear_shot.h"
#include "core/material/medium.h"

namespace scattermeter {

// Relative error of a row's prediction, independent from row to row: that of six points on a patch
// in place of its samples. 3e-5 at least; 1e-4 where a mean free path (1 / sigma_t') equals the
// patch width, growing with its inverse square below that. Domain: both > 0.
double row_method_error(double patch_size_mm, double mean_free_path_mm);

// Adds the errors common to rows: one for every octave of distances and one for every shot as a
// whole, each 1.5e-5 of its contribution to the image, as nuisances that are not fitted (group
// "numerics"). The forward model agrees with adaptive quadrature to 1e-5 in the mean over a cube
// (tests/core/diffusion/pair_sums_test.cc), incident light and knots included. Where the light
// decays within a patch's width (a mean free path 1 / sigma_t', or 1 / sigma_tr where that is
// shorter), the curvature of R over the patch dominates: the errors grow with the fourth power of
// the ratio, like the error of quadrature rules of degree 4, up to a factor of 4^4. r: the first
// estimate of scale * R on the knots. A system without shot_rows is one shot.
void add_method_errors(const DistanceKnots& knots, const Eigen::VectorXd& r, double patch_size_mm,
                       const Medium& medium, DenseSystem& system);

}  // namespace scattermeter
