// Reduction of an image, and likewise of its model, to the diffuse reflectance at quantised
// distances.
#pragma once

#include "core/diffusion/distance_weights.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// The paper recovers r' = U⁺ l on uniform knots (U: `uniform`, eq. 28) and compares it with R at
// the knots (eq. 30). R is not linear between knots, so r' of an exact image differs from R(d'_i),
// most at d = 0, and more for wider spacing of the knots. Here a candidate R is put through the
// same reduction before the comparison: r'(R) = U⁺ (W R), W the smooth weights of `system`.
// Whatever the width, the true R then reproduces r' exactly; a large width loses information but
// introduces no bias.
//
// Returned are K rows, K being the rank of U: the components of r' with independent errors, each
// divided by its deviation (RecoveredReflectance::whitened), with
//   weights = Qᵀ S⁻¹ W, l = Qᵀ S⁻¹ l, nuisance columns likewise, std_l = 1,
// Q an orthonormal basis of the columns of S⁻¹ U, S the deviations of l. Least squares on these
// rows is least squares of r'(R) - r' in the metric of the errors of r'; directions that the image
// does not determine are in no row. fit_dipole() accepts this system; its residual figures then
// refer to r', not to the image.
//
// Preconditions (std::invalid_argument): `uniform` has as many rows as the system.
// `rank_tolerance`: as of recover_reflectance().
DenseSystem quantise(const DenseSystem& system, const WeightMatrix& uniform,
                     double rank_tolerance = 1e-12);

}  // namespace scattermeter
