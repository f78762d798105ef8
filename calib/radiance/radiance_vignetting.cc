// Vignetting from the light of the flats' blocks.
#include <cmath>

#include <fmt/core.h>

#include "calib/radiance/radiance_steps.h"
#include "calib/radiance/vignetting_fit.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {

void find_vignetting(RadianceSteps& steps) {
  capture::RadianceCalibration& calibration = steps.calibration;
  capture::RadianceCorrection& correction = calibration.correction;
  std::array<double, kRgb> sum{}, n{};
  for (std::size_t k = 0; k < steps.blocks.size(); ++k) {
    const auto c =
        static_cast<std::size_t>(steps.cfa.phase[static_cast<std::size_t>(steps.blocks[k].phase)]);
    if (!(steps.light[k].per_s > 0.0)) continue;
    sum[c] += steps.light[k].per_s * steps.light[k].samples;
    n[c] += steps.light[k].samples;
  }
  std::vector<FlatLight> lights;
  for (std::size_t k = 0; k < steps.blocks.size(); ++k) {
    const RadianceSteps::Light& l = steps.light[k];
    if (!(l.per_s > 0.0)) continue;
    const auto c =
        static_cast<std::size_t>(steps.cfa.phase[static_cast<std::size_t>(steps.blocks[k].phase)]);
    lights.push_back({steps.blocks[k], c, l.per_s - correction.glare_share[c] * sum[c] / n[c],
                      l.relative_variance * l.per_s * l.per_s, l.shared});
  }
  const VignettingFit fit = fit_vignetting(lights, correction.width_px, correction.height_px);
  if (!fit.ok) {
    throw InputError(steps.input.shots.at(steps.input.shots.line) + ": calibration.radiance.flats",
                     fmt::format("vignetting: {} of {} blocks of the frame are usable, too few",
                                 lights.size(), steps.blocks.size()));
  }
  correction.vignetting = fit.vignetting;
  correction.vignetting_std = fit.rms_std;
  calibration.residuals.push_back({"flat field against vignetting", std::sqrt(fit.reduced_chi2),
                                   100.0 * fit.worst, 2.0, "standard deviations (worst: %)"});
}

}  // namespace scattermeter::calib
