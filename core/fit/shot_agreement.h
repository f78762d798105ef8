// Whether the shots of one material agree.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/fit/dipole_solver.h"
#include "core/fit/image_information.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// The paper's table 3 as a test: how far the chi-square falls when every shot may have coefficients
// of its own while light, pose, scale and the errors of the method stay common to all, each within
// its prior. Where the shots agree the fall is chi-square distributed with 2 (shots - 1) degrees of
// freedom.
struct ShotAgreement {
  double chi2 = 0;
  int dof = 0;         // 0: a single shot, nothing to compare
  double p_value = 1;  // probability of at least this fall where the shots agree
  // Shots that agree would fall so far less often than once in 1000.
  bool disagree() const { return dof > 0 && p_value <= 1e-3; }
};

// Linearised at the joint optimum; chi-squares are divided by `noise_inflation`. `nuisances`: the
// image's; those that are not fitted take part with their standard deviations.
ShotAgreement shot_agreement(const std::vector<ShotInformation>& shots,
                             const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                             const DipoleSolver::Point& joint, double eta_int_over_ext,
                             const ScalePrior& scale, double noise_inflation);

// The same from the estimate of every shot: `estimates` holds (log sigma_s', sigma_a), or other two
// unknowns, of one shot after the other, and `covariance` all that they share and do not. Where
// shots agree the estimates scatter about their best common value as chi-square.
// Precondition (std::invalid_argument): sizes agree and are even.
ShotAgreement agreement_of(const Eigen::VectorXd& estimates, const Eigen::MatrixXd& covariance);

// Widens deviations and intervals by sqrt(chi2 / dof) (Birge's ratio) where shots disagree; a line
// "disagreement" in the budget states how much that adds.
void widen_by_disagreement(const ShotAgreement& agreement, Estimate& estimate);

}  // namespace scattermeter
