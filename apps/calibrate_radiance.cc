#include "apps/calibrate_radiance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/core.h>

#include "apps/radiance_steps.h"
#include "apps/text_table.h"
#include "core/input_error.h"

namespace scattermeter::apps {

RadianceResult calibrate_radiance(const Rig& rig, const RadianceFrameSource& open) {
  if (!rig.calibration.radiance) {
    throw InputError(rig.path + ": calibration.radiance", "is missing: it lists the shots");
  }
  RadianceResult result;
  RadianceSteps steps{rig, open, result, {}};
  find_dark(steps);
  find_response_and_noise(steps);
  find_glare(steps);
  find_vignetting(steps);
  find_scale(steps);
  return result;
}

std::string radiance_table(const RadianceCalibration& calibration) {
  using Align = TextTable::Align;
  const capture::RadianceCorrection& c = calibration.correction;
  TextTable table({{"calibration", Align::kLeft}, {"value"}, {"std"}, {"unit", Align::kLeft}});
  const auto add = [&](const std::string& what, double value, double std, const std::string& unit) {
    table.add_row({what, fmt::format("{:.5g}", value), fmt::format("{:.2g}", std), unit});
  };
  double black = 0, rate = 0;
  for (std::size_t p = 0; p < 4; ++p) {
    black += 0.25 * c.black_counts[p];
    rate += 0.25 * c.dark_counts_per_s[p];
  }
  add("black", black, c.black_std_counts, "counts");
  table.add_row({"dark current", fmt::format("{:.5g}", rate), "", "counts/s"});
  table.add_row({"defect pixels", fmt::format("{}", c.defect_pixels.size()), "", ""});
  for (std::size_t k = 0; k < kRgb; ++k) {
    const std::string name(1, kRgbName[k]);
    add("gain " + name, c.noise[k].gain_e_per_count, calibration.gain_std_e_per_count[k],
        "e/count");
    add("read noise " + name, c.noise[k].read_noise_counts, calibration.read_noise_std_counts[k],
        "counts");
  }
  const ResponseCurve& curve = c.response[0];
  const std::size_t n = curve.knot_counts().size();
  for (std::size_t i = 0; i < n; ++i) {
    add(fmt::format("departure at {:.0f} counts", curve.knot_counts()[i]),
        -100.0 * curve.log_ratio()[i],
        100.0 * std::sqrt(calibration.response_covariance[0][i * (n + 1)]), "%");
  }
  for (const capture::ShutterSetting& s : c.shutter) {
    add(fmt::format("time stated {:.5g} s", s.stated_s), s.stated_s * s.true_over_stated,
        s.stated_s * s.true_over_stated * s.relative_std, "s");
  }
  for (std::size_t k = 0; k < kRgb; ++k) {
    add(fmt::format("light in the corner {}", kRgbName[k]), 100.0 * c.vignetting.share(0, 0, k),
        100.0 * c.vignetting_std, "% of the centre's");
  }
  for (std::size_t k = 0; k < kRgb; ++k) {
    add(fmt::format("veiling glare {}", kRgbName[k]), 100.0 * c.glare_share[k],
        100.0 * c.glare_std[k], "% of the frame's mean");
  }
  if (calibration.responsivity) {
    for (std::size_t k = 0; k < kRgb; ++k) {
      const double r = (*calibration.responsivity)[k];
      add(fmt::format("responsivity {}", kRgbName[k]), r, r * calibration.responsivity_relative_std,
          "counts mm^2 sr/(W s)");
    }
  }
  TextTable residuals({{"residuals", Align::kLeft},
                       {"rms"},
                       {"worst"},
                       {"limit of rms"},
                       {"unit", Align::kLeft},
                       {"", Align::kLeft}});
  for (const RadianceResidual& r : calibration.residuals) {
    residuals.add_row({r.what, fmt::format("{:.3g}", r.rms), fmt::format("{:.3g}", r.worst),
                       fmt::format("{:.3g}", r.limit), r.unit, r.rms <= r.limit ? "" : "EXCEEDED"});
  }
  std::string out = table.text() + "\n" + residuals.text();
  for (const std::string& note : calibration.notes) out += "note: " + note + "\n";
  return out;
}

}  // namespace scattermeter::apps
