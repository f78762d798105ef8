// Score tests of quantities that the rig states as known against the image.
#pragma once

#include <string>
#include <vector>

#include "core/diffusion/distance_weights.h"
#include "core/fit/dipole_solver.h"
#include "core/fit/estimate.h"
#include "core/fit/linear_shot.h"
#include "core/fit/recovered_reflectance.h"

namespace scattermeter {

// The offset of the best-fitting value of one stated quantity from its stated value, all else free.
struct ScoreTest {
  double offset = 0;          // best minus stated: of log scale, or of eta
  double p_value = 1;         // of at least this offset if the stated value is true
  double image_relative = 0;  // change of the image by the offset, relative to the image
  // Part of the residual that the offset explains, besides what was fitted, relative to the image.
  double explained_relative = 0;
  Eigen::VectorXd per_offset;  // d (sqrt_information R) / d offset
};

// One-parameter score tests at the fit's optimum. They detect a single wrong quantity long before
// the misfit over all d directions of r does, where one cause must raise the chi-square about
// sqrt(2 d) times more to be as improbable. Linearised; all nuisances, also those that are not
// fitted, vary within their priors, so errors of the method are not mistaken for the rig's.
// `noise`: variance of the rows over the stated one. Under uniform light the image hardly
// determines the scale, and no test can detect an error of it.
struct ScoreTests {
  ScoreTest scale;  // beyond its prior; p is 1 where it is free
  ScoreTest eta;
};
ScoreTests score_tests(const RecoveredReflectance& recovered,
                       const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                       const DipoleSolver::Point& optimum, double eta_int_over_ext,
                       const ScalePrior& scale, double noise);

// A sentence for the user. An offset beyond 1 is no quantity's, but says that the model is far off.
std::string contradiction_sentence(const ScoreTest& test, const std::string& quantity);

}  // namespace scattermeter
