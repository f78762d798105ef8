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
// (tests/core/diffusion/pair_sums_test.cc), incident light and knots included. Where light decays
// within a few patches (a mean free path 1 / sigma_t', or 1 / sigma_tr where that is shorter), the
// points that stand for a row's samples and the cubic that corrects for their positions dominate:
// 1.5e-4 where that length equals the patch width, growing with its inverse square up to a factor
// of 16 (tests/apps/instrument/sampled_patches_test.cc). r: the first estimate of scale * R on the
// knots. A system without shot_rows is one shot.
void add_method_errors(const DistanceKnots& knots, const Eigen::VectorXd& r, double patch_size_mm,
                       const Medium& medium, DenseSystem& system);

}  // namespace scattermeter
