#include "core/estimation/transport_start.h"

#include <algorithm>
#include <cmath>

namespace scattermeter {
namespace {

bool determines(const Estimate& dipole) {
  return dipole.converged && !is_undetermined(dipole.sigma_s_prime_per_mm);
}

double squared_distance(const Estimate& one, const Estimate& other) {
  constexpr double kDilute = 1e-3;  // sigma_a / sigma_s' below which media are alike
  const double a = one.sigma_s_prime_per_mm.value;
  const double b = other.sigma_s_prime_per_mm.value;
  const double scattering = std::log(a / b);
  const double absorption = std::log((one.sigma_a_per_mm.value / a + kDilute) /
                                     (other.sigma_a_per_mm.value / b + kDilute));
  return scattering * scattering + 0.1 * absorption * absorption;
}

}  // namespace

void start_like_others(std::span<const ChannelResult> found, const std::string& material,
                       Estimate& start) {
  constexpr double kSimilar = 1.0;  // squared distance
  const bool has_start = determines(start);
  const ChannelResult* like = nullptr;
  double least = kSimilar;
  for (const ChannelResult& r : found) {
    if (!r.dipole || !r.estimate.converged || r.refused()) continue;
    if (!has_start) {
      if (like == nullptr || r.material == material) like = &r;
    } else if (determines(*r.dipole) && squared_distance(*r.dipole, start) < least) {
      least = squared_distance(*r.dipole, start);
      like = &r;
    }
  }
  if (like == nullptr) return;
  double& s = start.sigma_s_prime_per_mm.value;
  double& a = start.sigma_a_per_mm.value;
  const Estimate& to = like->estimate;
  if (has_start) {
    s *= to.sigma_s_prime_per_mm.value / like->dipole->sigma_s_prime_per_mm.value;
    a += to.sigma_a_per_mm.value - like->dipole->sigma_a_per_mm.value;
  } else {
    s = to.sigma_s_prime_per_mm.value;
    a = to.sigma_a_per_mm.value;
  }
  a = std::max(0.0, a);
}

}  // namespace scattermeter
