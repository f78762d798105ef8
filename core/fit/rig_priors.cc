#include "core/fit/rig_priors.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace scattermeter {

std::vector<Nuisance> RigPriors::fitted() const {
  std::vector<Nuisance> out;
  std::copy_if(nuisances.begin(), nuisances.end(), std::back_inserter(out),
               [](const Nuisance& n) { return n.fitted; });
  return out;
}

ModelJudgement judgement_of(const RigPriors& priors, const RecoveredReflectance& recovered,
                            const DipoleCurve& curve, const DipoleSolver::Point& optimum) {
  const bool is_free = std::isinf(priors.scale.relative_std);
  // A stated scale varies about 1, wherever the optimum is.
  const double s = is_free ? std::exp(optimum.log_s) : 1.0;
  const double per_noise = 1.0 / std::sqrt(recovered.noise_excess());
  const auto n = static_cast<Eigen::Index>(priors.nuisances.size());
  const Eigen::MatrixXd kernel = per_noise * recovered.sqrt_information.leftCols(curve.r.size());
  const Eigen::VectorXd nominal = kernel * (s * curve.r);
  WhitenedModel model;
  model.residual = per_noise * recovered.whitened - nominal;
  model.free.resize(nominal.size(), is_free ? 3 : 2);
  const double per_sigma_t = 1.0 / optimum.sigma_t_prime_per_mm();
  model.free.leftCols(2) << kernel * (s * per_sigma_t * (curve.d_u - optimum.q * curve.d_q)),
      kernel * (s * per_sigma_t * (curve.d_u + (1.0 - optimum.q) * curve.d_q));
  model.columns.resize(nominal.size(), n + (is_free ? 0 : 1));
  model.columns.leftCols(n) = per_noise * recovered.sqrt_information.rightCols(n);
  (is_free ? model.free : model.columns).rightCols(1) = nominal;
  model.nuisances = priors.nuisances;
  if (!is_free) model.nuisances.push_back({"scale", priors.scale.relative_std, true, "scale"});
  model.data_length = per_noise * recovered.whitened.norm();
  return judge(model);
}

bool widen_doubtful(const std::vector<PriorPull>& pulls, const JointPulls& joint,
                    RigPriors& priors) {
  bool any = false;
  for (const PriorPull& p : pulls) {
    const auto known = joint.find(p.name);
    const double size = std::abs(known == joint.end() ? p.pull : known->second);
    if (!(size > kDoubtfulPull)) continue;
    if (p.group == "scale") {
      priors.scale.relative_std *= size;
      any = any || priors.scale.relative_std > 0.0;
    }
    for (Nuisance& n : priors.nuisances) {
      if (!n.fitted || n.name.empty() || n.name != p.name) continue;
      n.std *= size;
      any = true;
    }
  }
  return any;
}

}  // namespace scattermeter
