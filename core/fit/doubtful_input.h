// What the rig states as known, held against the image.
#pragma once

#include <vector>

#include "core/diffusion/distance_weights.h"
#include "core/fit/dipole_solver.h"
#include "core/fit/estimate.h"
#include "core/fit/linear_shot.h"
#include "core/fit/recovered_reflectance.h"

namespace scattermeter {

// How far the image wants one stated quantity from what is stated, all else free.
struct Doubt {
  double offset = 0;          // wanted minus stated: of log scale, or of eta
  double p_value = 1;         // of at least this much where the statement is true
  double image_relative = 0;  // what the offset does to the image, relative to the image
  Eigen::VectorXd push;       // d (sqrt_information R) / d offset
};

// One-parameter score tests at the fit's optimum. Where one cause is wrong they see it long before
// the misfit over all directions of r does: with d of those, a cause must raise the chi-square by
// some sqrt(2 d) times more to be as improbable. Linearised; all nuisances, also those that are not
// fitted, take part within their priors, so errors of the method are not taken for the rig's.
// `noise`: variance of the rows over what is stated. Where light is even over the object the image
// itself hardly holds the scale, and no test can tell.
struct Doubts {
  Doubt scale;  // beyond its prior; none where it is free
  Doubt eta;
};
Doubts doubtful_inputs(const RecoveredReflectance& recovered,
                       const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                       const DipoleSolver::Point& optimum, double eta_int_over_ext,
                       const ScalePrior& scale, double noise);

}  // namespace scattermeter
