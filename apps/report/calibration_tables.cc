#include "apps/report/calibration_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>

#include "apps/report/text_table.h"

namespace scattermeter::apps {

std::string board_name(const calib::CalibrationBoard& board) {
  const bool charuco = board.kind == calib::BoardKind::kCharuco;
  return fmt::format("{} board of {} x {} squares of {:g} mm", charuco ? "ChArUco" : "chess",
                     board.squares_x, board.squares_y, board.square_mm);
}

std::string camera_calibration_table(const calib::CalibrationBoard& board,
                                     const calib::CameraCalibrationRun& run) {
  const calib::CameraCalibration& c = run.calibration;
  std::string text = fmt::format("{}, {} shots\n", board_name(board), run.n_shots);
  for (const calib::LeftOutView& view : c.left_out) {
    text += fmt::format("left out: {}: {}\n", view.name, view.reason);
  }
  for (const calib::LeftOutCorner& corner : c.corners_left_out) {
    text += fmt::format("left out: a corner of {} at ({:.1f}, {:.1f}): {:.2f} px off\n",
                        corner.view, corner.image_px.x(), corner.image_px.y(), corner.distance_px);
  }
  if (c.status != calib::CameraCalibrationStatus::kOk) return text;
  using Align = TextTable::Align;
  TextTable values({{"", Align::kLeft}, {"value"}, {"std"}, {"unit", Align::kLeft}});
  for (std::size_t i = 0; i < c.parameters.size(); ++i) {
    const std::string& name = c.parameters[i];
    const bool px = name.ends_with("_px");
    values.add_row({px ? name.substr(0, name.size() - 3) : name,
                    px ? fmt::format("{:.3f}", c.value(i)) : fmt::format("{:.5f}", c.value(i)),
                    px ? fmt::format("{:.3f}", c.std(i)) : fmt::format("{:.5f}", c.std(i)),
                    px ? "px" : "1"});
  }
  text += "\n" + values.text();
  const auto worst =
      std::max_element(c.views.begin(), c.views.end(),
                       [](const auto& a, const auto& b) { return a.worst_px < b.worst_px; });
  text +=
      fmt::format("\nresiduals of {} corners in {} views: rms {:.3f} px, worst {:.3f} px ({})\n",
                  c.residuals.size(), c.views.size(), c.rms_px, c.worst_px, worst->name);
  if (c.widened) {
    text += fmt::format(
        "the views differ {:.1f} times as much as the noise of their corners explains (bent board, "
        "blur): the std above are increased by this factor\n",
        std::sqrt(c.view_scatter));
  }
  text += fmt::format("a ray's image is known to {:.2f} px (std) at the frame's worst corner\n\n",
                      c.frame_corner_std_px);
  TextTable models(
      {{"lens model", Align::kLeft}, {"rms, px"}, {"left-out views, px"}, {"", Align::kLeft}});
  for (std::size_t i = 0; i < c.candidates.size(); ++i) {
    const calib::LensCandidate& m = c.candidates[i];
    const bool good = m.fault.empty();
    models.add_row({lens_model_name(m.model), m.rms_px > 0 ? fmt::format("{:.4f}", m.rms_px) : "-",
                    good ? fmt::format("{:.4f}", m.left_out_rms_px) : "-",
                    i == c.chosen ? "chosen" : m.fault});
  }
  text += models.text();
  for (const std::string& warning : c.warnings) text += "warning: " + warning + "\n";
  return text;
}

std::string led_calibration_table(const calib::LedCalibration& calibration) {
  using Align = TextTable::Align;
  const calib::LedFit& fit = calibration.fit;
  std::string text;
  if (fit.status != calib::LedStatus::kOk) {
    text = calibration.light + ": refused: " + fit.message + "\n";
  } else {
    TextTable table(
        {{calibration.light, Align::kLeft}, {"value"}, {"std"}, {"unit", Align::kLeft}});
    const LedMatrix& c = fit.uncertainty.covariance;
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
      const double axis_std =
          std::sqrt((by * c.block<2, 2>(kLedAxis, kLedAxis) * by.transpose()).value());
      table.add_row({fmt::format("axis {}", "xyz"[i]), fmt::format("{:.5f}", fit.led.axis[i]),
                     fmt::format("{:.5f}", axis_std), ""});
    }
    table.add_row({"exponent", fmt::format("{:.5f}", fit.led.exponent),
                   fmt::format("{:.5f}", std(kLedExponent)), ""});
    for (Eigen::Index i = 0; i < 3; ++i) {
      const double intensity = fit.led.intensity_W_per_sr[i];
      table.add_row({fmt::format("intensity {}", "RGB"[i]), fmt::format("{:.6g}", intensity),
                     fmt::format("{:.3g}", intensity * std(kLedLogIntensity + i)), "W/sr"});
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

std::string led_calibration_verdict(const calib::LedCalibration& calibration) {
  const LedMatrix& c = calibration.fit.uncertainty.covariance;
  const double position_mm = std::sqrt(c.topLeftCorner<3, 3>().trace());
  if (!calibration.fit.lobe_fitted) {
    return fmt::format(
        "The position is known to {:.2g} mm; axis, exponent and intensity are those of the rig, as "
        "no white plane was seen.",
        position_mm);
  }
  const double axis_rad = std::sqrt(c.block<2, 2>(kLedAxis, kLedAxis).trace());
  const double log_intensity = std::sqrt(c.diagonal().segment<3>(kLedLogIntensity).maxCoeff());
  return fmt::format(
      "The position is known to {:.2g} mm, the axis to {:.2g} degrees, the intensity to {:.2g} %.",
      position_mm, axis_rad * 180.0 / std::numbers::pi, 100.0 * log_intensity);
}

std::string radiance_calibration_table(const capture::RadianceCalibration& calibration) {
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
  for (const capture::RadianceResidual& r : calibration.residuals) {
    residuals.add_row({r.what, fmt::format("{:.3g}", r.rms), fmt::format("{:.3g}", r.worst),
                       fmt::format("{:.3g}", r.limit), r.unit, r.rms <= r.limit ? "" : "EXCEEDED"});
  }
  std::string out = table.text() + "\n" + residuals.text();
  for (const std::string& note : calibration.notes) out += "note: " + note + "\n";
  return out;
}

}  // namespace scattermeter::apps
