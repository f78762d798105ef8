// Starting points of the search for the best dipole.
#pragma once

#include <vector>

#include "core/fit/dipole_solver.h"

namespace scattermeter {

// For mean free paths a factor of sqrt(2) apart over all that the knots resolve, the best absorbed
// share q is found. Returned are the minima along that line: one to three, the best first. The
// scale is solved for unless it is exact. The residual is s kernel R - whitened, as DipoleSolver's,
// nuisances eliminated (v is empty); the scale's prior belongs to the cost.
std::vector<DipoleSolver::Point> dipole_starts(const Eigen::MatrixXd& kernel,
                                               const Eigen::VectorXd& whitened,
                                               const DistanceKnots& knots, double eta_int_over_ext,
                                               const ScalePrior& scale);

}  // namespace scattermeter
