// An image reduced to the diffuse reflectance on quantised distances, and a model reduced alike.
#pragma once

#include "core/diffusion/distance_weights.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// The paper recovers r' = U⁺ l on uniform knots (U: `uniform`, eq. 28) and compares it with R at
// the knots (eq. 30). R is not linear between knots, so r' of an exact image differs from R(d'_i),
// most at d = 0, and the more the wider the knots. Here a candidate R is put through the same
// reduction before the comparison: r'(R) = U⁺ (W R), W the smooth weights of `system`. Whatever the
// width, the candidate that made the image then meets r' exactly; a wide width loses information,
// not truth.
//
// Returned are K rows, as many as U has rank: the components of r' in which its errors are
// independent, each divided by its deviation (RecoveredReflectance::whitened), with
//   weights = Qᵀ S⁻¹ W, l = Qᵀ S⁻¹ l, nuisance columns likewise, std_l = 1,
// Q an orthonormal basis of the columns of S⁻¹ U, S the deviations of l. Least squares on these
// rows is least squares of r'(R) - r' in the metric of the errors of r'; knots that the image does
// not determine are in no row. fit_dipole() takes the system as it is; its residual figures then
// speak of r', not of the image.
//
// Preconditions (std::invalid_argument): as many rows in `uniform` as in the system.
// `rank_tolerance`: as of recover_reflectance().
DenseSystem quantise(const DenseSystem& system, const WeightMatrix& uniform,
                     double rank_tolerance = 1e-12);

}  // namespace scattermeter
