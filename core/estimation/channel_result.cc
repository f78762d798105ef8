#include "core/estimation/channel_result.h"

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

}  // namespace scattermeter
