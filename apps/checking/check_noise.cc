#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "apps/checking/check.h"

namespace scattermeter::apps {
namespace {

// Standard deviations of the scatter, as the model has it, that chance may cause: of 20 independent
// samples, once in 10^5 shots.
constexpr double kNoiseStds = 6.0;

// Of each shot and channel: the scatter of its samples, % above the model.
std::vector<CheckDetail> excess_of(const CheckedRig& checked) {
  std::vector<CheckDetail> excess;
  for (std::size_t i = 0; i < checked.shots.size(); ++i) {
    for (std::size_t c = 0; c < kRgb; ++c) {
      double seen = 0.0;
      double model_variance = 0.0;  // of the sum, where the noise is the model's
      double model = 0.0;
      for (const capture::NoisePoint& p : checked.frames[i].noise[c]) {
        const auto n = static_cast<double>(p.triples);
        seen += n * p.variance_counts2;
        model += n * p.model_counts2;
        model_variance += std::pow(n * p.model_counts2 * p.relative_std, 2);
      }
      if (!(model > 0.0)) continue;
      CheckDetail d = checked.of_channel(i, c, 100.0 * (seen / model - 1.0));
      d.std = 100.0 * std::sqrt(model_variance) / model;
      excess.push_back(d);
    }
  }
  return excess;
}

}  // namespace

std::vector<CheckItem> check_noise(const CheckedRig& checked) {
  return {judged("noise", "% above the model",
                 {checked.options.max_noise_percent, false, true, kNoiseStds},
                 "set camera.sensor gain and read noise for this ISO", excess_of(checked))};
}

std::string quiet_note(const CheckedRig& checked) {
  constexpr double kQuiet = -75.0;  // half the stated deviation
  std::vector<CheckDetail> quiet = excess_of(checked);
  std::erase_if(quiet, [](const CheckDetail& d) {
    return !(d.value < kQuiet) || !(-d.value > kNoiseStds * d.std);
  });
  if (quiet.empty()) return "";
  const CheckDetail& most = *std::min_element(
      quiet.begin(), quiet.end(),
      [](const CheckDetail& a, const CheckDetail& b) { return a.value < b.value; });
  return fmt::format(
      "noise: {} channels of shots scatter less than half as much as camera.sensor states, {} the "
      "least ({:.2g} of the variance): the stated uncertainties are too large, and errors of the "
      "rig are harder to detect; set camera.sensor gain_e_per_count and read_noise_counts for this "
      "ISO",
      quiet.size(), most.where, std::max(0.0, 1.0 + most.value / 100.0));
}

}  // namespace scattermeter::apps
