#include "core/estimation/transport_start.h"

#include <algorithm>
#include <cmath>

namespace scattermeter {

void start_like_others(std::span<const ChannelResult> found, Estimate& estimate) {
  constexpr double kSimilar = 1.0;  // squared distance
  constexpr double kDilute = 1e-3;  // sigma_a / sigma_s' below which media are alike
  const auto squared_distance = [&](const Estimate& dipole) {
    const double a = dipole.sigma_s_prime_per_mm.value;
    const double b = estimate.sigma_s_prime_per_mm.value;
    const double scattering = std::log(a / b);
    const double absorption = std::log((dipole.sigma_a_per_mm.value / a + kDilute) /
                                       (estimate.sigma_a_per_mm.value / b + kDilute));
    return scattering * scattering + 0.1 * absorption * absorption;
  };
  const ChannelResult* most_similar = nullptr;
  double least = kSimilar;
  for (const ChannelResult& r : found) {
    if (r.model != "transport" || !r.estimate.converged || !r.dipole || !r.dipole->converged) {
      continue;
    }
    const double distance = squared_distance(*r.dipole);
    if (!(distance < least)) continue;
    least = distance;
    most_similar = &r;
  }
  if (most_similar == nullptr) return;
  const Estimate& from = *most_similar->dipole;
  const Estimate& to = most_similar->estimate;
  estimate.sigma_s_prime_per_mm.value *=
      to.sigma_s_prime_per_mm.value / from.sigma_s_prime_per_mm.value;
  estimate.sigma_a_per_mm.value = std::max(
      0.0, estimate.sigma_a_per_mm.value + to.sigma_a_per_mm.value - from.sigma_a_per_mm.value);
}

}  // namespace scattermeter
