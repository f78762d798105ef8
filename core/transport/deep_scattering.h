// Scattering far from the surface, where its phase function no longer matters.
#pragma once

#include <algorithm>

#include "core/material/scattering_medium.h"

namespace scattermeter {

// The isotropic medium that stands for another of the same sigma_s' and sigma_a deep inside a body
// (similarity of first order). It begins so deep that no light comes from there to the camera
// without a further scattering: paths are not connected from it.
struct DeepScattering {
  // beyond: PathOptions::isotropic_beyond.
  DeepScattering(const ScatteringMedium& medium, double beyond) {
    const double sigma_s_prime_per_mm = medium.sigma_s_per_mm * (1.0 - medium.phase.mean_cosine());
    mean_free_path_mm = 1.0 / (sigma_s_prime_per_mm + medium.sigma_a_per_mm);
    albedo = sigma_s_prime_per_mm * mean_free_path_mm;
    // Light from below goes unseen: 4e-4 of all that the camera sees (3 exp(-9)), where its source
    // grows threefold down to there, as below a lit surface.
    constexpr double kUnseenMeanFreePaths = 9.0;
    least_mm =
        std::max(beyond / sigma_s_prime_per_mm, kUnseenMeanFreePaths / medium.sigma_t_per_mm());
    constexpr double kWorthTheChange = 0.25;
    enters_mm = least_mm + kWorthTheChange / sigma_s_prime_per_mm;
  }

  double mean_free_path_mm = 0;
  double albedo = 0;
  double least_mm = 0;   // distance from the surface down to which it stands
  double enters_mm = 0;  // and from which on a path changes over
};

}  // namespace scattermeter
