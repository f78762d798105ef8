#include "apps/led_calibration.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "apps/text_table.h"

namespace scattermeter::apps {

LedCalibration calibrate_led(const Rig& rig, const std::string& light, const LedFrames& frames) {
  LedCalibration out;
  out.light = light;
  out.shots = read_led_shots(rig, light, frames);
  const RigLight& told = rig.light(light);
  calib::LedFitOptions options;
  options.ambient = rig.calibration.led->ambient;
  options.exponent_std = told.exponent_std;
  options.log_intensity_std = told.power_relative_std;
  if (told.calibrated) {
    const calib::LedMatrix& c = told.calibrated->covariance;
    options.exponent_std = std::sqrt(c(calib::kLedExponent, calib::kLedExponent));
    options.log_intensity_std =
        std::sqrt(c.diagonal().segment<3>(calib::kLedLogIntensity).maxCoeff());
  }
  out.fit = calib::fit_led(out.shots.scene, told.led, options);
  return out;
}

std::string led_calibration_table(const LedCalibration& calibration) {
  using Align = TextTable::Align;
  const calib::LedFit& fit = calibration.fit;
  std::string text;
  if (fit.status != calib::LedStatus::kOk) {
    text = calibration.light + ": refused: " + fit.message + "\n";
  } else {
    TextTable table(
        {{calibration.light, Align::kLeft}, {"value"}, {"std"}, {"unit", Align::kLeft}});
    const calib::LedMatrix& c = fit.uncertainty.covariance;
    const auto std = [&](Eigen::Index i) { return std::sqrt(c(i, i)); };
    for (Eigen::Index i = 0; i < 3; ++i) {
      table.add_row({fmt::format("position {}", "xyz"[i]),
                     fmt::format("{:.4f}", fit.led.position_mm[i]), fmt::format("{:.4f}", std(i)),
                     "mm"});
    }
    table.add_row({"distance", fmt::format("{:.4f}", fit.distance_mm),
                   fmt::format("{:.4f}", fit.distance_std_mm), "mm"});
    for (Eigen::Index i = 0; i < 3; ++i) {
      Eigen::RowVector2d by(fit.uncertainty.tangents[0][i], fit.uncertainty.tangents[1][i]);
      const double axis_std = std::sqrt(
          (by * c.block<2, 2>(calib::kLedAxis, calib::kLedAxis) * by.transpose()).value());
      table.add_row({fmt::format("axis {}", "xyz"[i]), fmt::format("{:.5f}", fit.led.axis[i]),
                     fmt::format("{:.5f}", axis_std), ""});
    }
    table.add_row({"exponent", fmt::format("{:.5f}", fit.led.exponent),
                   fmt::format("{:.5f}", std(calib::kLedExponent)), ""});
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double intensity = fit.led.intensity_W_per_sr[i];
      table.add_row({fmt::format("intensity {}", "RGB"[i]), fmt::format("{:.6g}", intensity),
                     fmt::format("{:.3g}", intensity * std(calib::kLedLogIntensity + i)), "W/sr"});
    }
    text = table.text();
  }
  const auto used = [](const std::vector<bool>& which) {
    return std::count(which.begin(), which.end(), true);
  };
  if (!fit.highlight_used.empty()) {
    text += fmt::format("highlights: {} of {} used, residual rms {:.3f} px, worst {:.3f} px\n",
                        used(fit.highlight_used), fit.highlight_used.size(), fit.highlight_rms_px,
                        fit.highlight_worst_px);
  }
  if (!fit.cell_used.empty()) {
    text += fmt::format("plane: {} of {} cells used, residual rms {:.3f} %, worst {:.3f} %\n",
                        used(fit.cell_used), fit.cell_used.size(), 100.0 * fit.plane_rms,
                        100.0 * fit.plane_worst);
  }
  for (const calib::FittedAmbient& a : fit.ambient) {
    text += fmt::format("ambient light of {}:", calibration.shots.grids.at(a.shot).file);
    for (Eigen::Index c = 0; c < 3; ++c) {
      if (std::isnan(a.relative[c])) continue;
      text += fmt::format(" {} {:.3f} +- {:.3f} %", "RGB"[c], 100.0 * a.relative[c],
                          100.0 * a.relative_std[c]);
    }
    text += " of the LED's, fitted\n";
  }
  return text;
}

}  // namespace scattermeter::apps
