#include "core/estimation/model_choice.h"

#include <fmt/core.h>

namespace scattermeter {

bool misses_image(const Estimate& estimate) {
  constexpr double kPValue = 1e-6;
  constexpr double kMisfit = 1e-3;
  return estimate.misfit_p_value < kPValue && estimate.misfit_relative > kMisfit;
}

double hidden_by_noise(const ChannelResult& result) {
  // A misfit is visible where it exceeds the noise in the directions that the dipole might miss
  // (some tens, together this many deviations of the whole image).
  constexpr double kDeviations = 8.0;
  return kDeviations / result.image_in_std;
}

std::string why_transport(const ChannelResult& result) {
  constexpr double kVisible = 5e-3;
  const Estimate& e = result.estimate;
  const double visible = hidden_by_noise(result);
  const bool misses = misses_image(e), disagree = result.agreement.disagree();
  const bool explains = e.converged && !misses && !disagree && visible <= kVisible;
  if (!e.reasons.empty() && !explains) return "the dipole is refused: " + e.reasons.front();
  if (misses) {
    return fmt::format("the dipole misses {:.2g} % of the image", 100.0 * e.misfit_relative);
  }
  if (disagree) return "the shots do not agree under the dipole";
  if (visible > kVisible) {
    return fmt::format("noise hides what the dipole may miss, up to {:.2g} % of the image",
                       100.0 * visible);
  }
  return "";
}

}  // namespace scattermeter
