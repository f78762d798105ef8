// Errors of the forward model itself.
#pragma once

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/fit/linear_shot.h"
#include "core/material/medium.h"

namespace scattermeter {

// Error of a row's prediction, relative to l and alone in its row: the error of six points on a
// patch against its samples. 3e-5 at least; 1e-4 where a mean free path (1 / sigma_t') is as long
// as the patch is wide, and growing with its inverse square below that. Domain: both > 0.
double row_method_error(double patch_size_mm, double mean_free_path_mm);

// Adds the errors that rows share: of every octave of distances and of every shot as a whole, each
// 1.5e-5 of what it adds to the image, as nuisances that are held (group "numerics"). The forward
// model meets adaptive quadrature to 1e-5 in the mean over a cube
// (tests/core/diffusion/pair_sums_test.cc), incident light and knots included. Where the light
// decays within a patch's width (a mean free path 1 / sigma_t', or 1 / sigma_tr where that is
// shorter), the curvature of R over the patch takes over: growing with the fourth power of the
// ratio, as the error of the rules of degree 4 does, up to 4^4. r: the first estimate of scale * R
// on the knots. A system without shot_rows is one shot.
void add_method_errors(const DistanceKnots& knots, const Eigen::VectorXd& r, double patch_size_mm,
                       const Medium& medium, DenseSystem& system);

}  // namespace scattermeter
