#include "core/material/phase_effect.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scattermeter {

double near_entry_per_mm2(const Medium& medium, double distance_mm, double structure_mm) {
  constexpr double kReach = 0.165;  // l'
  const double reach_mm = std::max(kReach / medium.sigma_t_prime_per_mm(), structure_mm);
  const double x = distance_mm / reach_mm;
  return 1.0 / (std::numbers::pi * reach_mm * reach_mm * (1.0 + x * x) * (1.0 + x * x));
}

double phase_effect_per_mm2(const Medium& medium, double distance_mm, double structure_mm) {
  constexpr double kShare = 0.109, kShareByEta = 0.093;
  constexpr double kReach = 0.8;                                   // l'
  constexpr double kLeavesByAlbedo = 1.2, kArrivesByAlbedo = 4.0;  // exponents: scatterings lost
  const double sigma_t = medium.sigma_t_prime_per_mm();
  const double albedo = medium.sigma_s_prime_per_mm / sigma_t;
  const double share = std::max(0.0, kShare - kShareByEta * (medium.eta_int_over_ext - 1.0));
  const double reach_mm = std::max(kReach / sigma_t, structure_mm);
  const double arrives = distance_mm * std::exp(-distance_mm / reach_mm) /
                         (4.0 * std::numbers::pi * reach_mm * reach_mm * reach_mm);
  return share * (std::pow(albedo, kArrivesByAlbedo) * arrives -
                  std::pow(albedo, kLeavesByAlbedo) *
                      near_entry_per_mm2(medium, distance_mm, structure_mm));
}

double phase_turn(double eta_int_over_ext) {
  constexpr double kMatched = 0.23, kExponent = -5.0;
  return kMatched * std::pow(eta_int_over_ext, kExponent);
}

}  // namespace scattermeter
