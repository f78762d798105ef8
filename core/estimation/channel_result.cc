#include "core/estimation/channel_result.h"

#include <cmath>

#include "core/estimation/model_choice.h"

namespace scattermeter {

std::optional<DipoleDistance> dipole_distance(const ChannelResult& result) {
  if (!result.dipole || !result.dipole->converged || !result.estimate.converged ||
      is_undetermined(result.dipole->sigma_s_prime_per_mm)) {
    return std::nullopt;
  }
  return DipoleDistance{
      result.dipole->sigma_s_prime_per_mm.value / result.estimate.sigma_s_prime_per_mm.value - 1.0,
      result.dipole->sigma_a_per_mm.value - result.estimate.sigma_a_per_mm.value};
}

double bent_in_std(const Estimate& at, const ChannelResult& result) {
  constexpr double kNearer = 0.5;
  const Estimate& now = result.estimate;
  if (!at.converged || !now.converged) return 0.0;
  if (misses_image(now) && now.misfit_relative > kNearer * at.misfit_relative) return 0.0;
  // Of the exponent with which light decays in the depth, too.
  const auto decay = [](const Estimate& e) {
    return std::sqrt(3.0 * e.sigma_a_per_mm.value / e.sigma_s_prime_per_mm.value);
  };
  const double medium =
      std::hypot(std::log(now.sigma_s_prime_per_mm.value / at.sigma_s_prime_per_mm.value),
                 decay(now) - decay(at));
  double squares = 0.0;
  for (const PriorPull& p : now.pulls) {
    if (p.name != "scale") squares += p.image_relative * p.image_relative;
  }
  return result.image_in_std * medium * std::sqrt(squares);
}

}  // namespace scattermeter
