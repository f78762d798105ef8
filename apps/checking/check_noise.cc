#include <cmath>

#include "apps/checking/check.h"

namespace scattermeter::apps {
namespace {

// Standard deviations of the scatter, as the model has it, that chance may cause: of 20 independent
// samples, once in 10^5 shots.
constexpr double kNoiseStds = 6.0;

}  // namespace

std::vector<CheckItem> check_noise(const CheckedRig& checked) {
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
  return {judged("noise", "% above the model",
                 {checked.options.max_noise_percent, false, true, kNoiseStds},
                 "set camera.sensor gain and read noise for this ISO", excess)};
}

}  // namespace scattermeter::apps
