// A test of whether the shots of one material agree.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/fit/dipole_solver.h"
#include "core/fit/image_information.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// The paper's table 3 as a test: the drop of the chi-square when every shot may have its own
// coefficients while light, pose, scale and the errors of the method remain common to all, each
// within its prior. If the shots agree, the drop is chi-square distributed with 2 (shots - 1)
// degrees of freedom.
struct ShotAgreement {
  double chi2 = 0;
  int dof = 0;         // 0: a single shot, nothing to compare
  double p_value = 1;  // probability of at least this drop if the shots agree
  // Agreeing shots would have such a drop less than once in 1000 measurements.
  bool disagree() const { return dof > 0 && p_value <= 1e-3; }
};

// Linearised at the joint optimum; chi-squares are divided by `noise_inflation`. `nuisances`: the
// image's; those that are not fitted enter with their standard deviations.
ShotAgreement shot_agreement(const std::vector<ShotInformation>& shots,
                             const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                             const DipoleSolver::Point& joint, double eta_int_over_ext,
                             const ScalePrior& scale, double noise_inflation);

// The same from the estimates of the single shots: `estimates` has (log sigma_s', sigma_a), or two
// other unknowns, of one shot after another, and `covariance` their joint covariance, common errors
// included. If the shots agree, the scatter of the estimates about their best common value is
// chi-square distributed. Precondition (std::invalid_argument): sizes agree and are even.
ShotAgreement agreement_of(const Eigen::VectorXd& estimates, const Eigen::MatrixXd& covariance);

// Widens deviations and intervals by sqrt(chi2 / dof) (Birge's ratio) if the shots disagree; a line
// "disagreement" in the budget states the amount added.
void widen_by_disagreement(const ShotAgreement& agreement, Estimate& estimate);

}  // namespace scattermeter
