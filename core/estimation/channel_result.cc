#include "core/estimation/channel_result.h"

namespace scattermeter {

std::optional<DipoleDistance> dipole_distance(const ChannelResult& r) {
  if (!r.dipole || !r.dipole->converged || !r.estimate.converged) return std::nullopt;
  return DipoleDistance{
      r.dipole->sigma_s_prime_per_mm.value / r.estimate.sigma_s_prime_per_mm.value - 1.0,
      r.dipole->sigma_a_per_mm.value - r.estimate.sigma_a_per_mm.value};
}

}  // namespace scattermeter
