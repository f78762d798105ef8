// Where a search for the dipole should begin.
#pragma once

#include <vector>

#include "core/fit/dipole_solver.h"

namespace scattermeter {

// Mean free paths a factor of sqrt(2) apart over all that the knots resolve, the best of absorbed
// shares from none to most for each: the minima along that line, at most three, the best first, at
// least one. The scale is solved for where it is not exact; nuisances are at 0 (v is empty).
std::vector<DipoleSolver::Point> dipole_starts(const RecoveredReflectance& recovered,
                                               const DistanceKnots& knots, double eta_int_over_ext,
                                               const ScalePrior& scale);

}  // namespace scattermeter
