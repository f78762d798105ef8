// What the rig states about its uncertain quantities, and the image's verdict on it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/diffusion/dipole_curve.h"
#include "core/fit/dipole_solver.h"
#include "core/fit/estimate.h"
#include "core/fit/linear_shot.h"
#include "core/fit/prior_pulls.h"
#include "core/fit/recovered_reflectance.h"

namespace scattermeter {

struct RigPriors {
  std::vector<Nuisance> nuisances;  // the fitted ones first
  ScalePrior scale;
  std::vector<Nuisance> fitted() const;
};

// The judgement on the fitted nuisances and on a scale with a prior at the dipole's optimum, in
// terms of the rows' noise as raised by the residual of the best r.
ModelJudgement judgement_of(const RigPriors& priors, const RecoveredReflectance& recovered,
                            const DipoleCurve& curve, const DipoleSolver::Point& optimum);

// Pulls of nuisances by name, from all channels together.
using JointPulls = std::map<std::string, double>;

// Multiplies the deviations of doubtful quantities by the size of their pulls, of the joint ones
// where they are known: what lies three deviations off is then one deviation off, instead of being
// drawn to its stated value. Returns whether there were any. (The idea is Birge's ratio, applied to
// one cause instead of the result.)
bool widen_doubtful(const std::vector<PriorPull>& pulls, const JointPulls& joint,
                    RigPriors& priors);

}  // namespace scattermeter
