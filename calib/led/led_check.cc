#include "calib/led/led_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "calib/led/cell_model.h"
#include "calib/led/led_fit.h"
#include "calib/led/led_start.h"
#include "core/base/dense_solve.h"
#include "core/base/median.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

constexpr double kNotSeen = std::numeric_limits<double>::quiet_NaN();

void hold_highlights(const Led& led, const LedShots& shots, LedCheck& check) {
  const Lens lens(shots.scene.intrinsics);
  double sum = 0.0;
  for (const SeenHighlight& h : shots.scene.highlights) {
    const Eigen::Vector2d r = highlight_px(lens, shots.scene.views[h.view].camera_from_world,
                                           shots.scene.spheres[h.sphere], led) -
                              h.image_px;
    check.highlights_px.push_back(h.image_px);
    check.highlight_residuals_px.push_back(r);
    sum += r.squaredNorm();
    // A highlight that the rig does not predict at all has no residual: the worst case.
    check.highlight_worst_px =
        r.allFinite() ? std::max(check.highlight_worst_px, r.norm()) : kNotSeen;
  }
  const double n = static_cast<double>(shots.scene.highlights.size());
  check.highlight_rms_px = n > 0.0 ? std::sqrt(sum / n) : kNotSeen;
  if (n == 0.0) check.highlight_worst_px = kNotSeen;
}

// The cells minus the fitted ambient light.
std::vector<ShadedCell> lit_by_led(const LedShots& shots, const LedFit& fit, LedCheck& check) {
  std::vector<ShadedCell> cells = shots.scene.cells;
  if (cells.empty()) check.ambient_percent = check.ambient_std_percent = kNotSeen;
  for (const FittedAmbient& a : fit.ambient) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      if (!(100.0 * a.relative[c] > check.ambient_percent)) continue;
      check.ambient_percent = 100.0 * a.relative[c];
      check.ambient_std_percent = 100.0 * a.relative_std[c];
      check.ambient_file = shots.grids.at(a.shot).file;
    }
    for (ShadedCell& cell : cells) {
      if (cell.shot == a.shot) cell.radiance_W_per_mm2_sr -= a.radiance_W_per_mm2_sr[cell.channel];
    }
  }
  return cells;
}

void hold_planes(const Led& led, const LedShots& shots, const LedFit& fit, LedCheck& check) {
  const std::vector<ShadedCell> cells = lit_by_led(shots, fit, check);
  std::vector<double> ratio;
  std::array<std::vector<double>, 3> of_channel;
  for (const ShadedCell& cell : cells) {
    const double predicted = cell_radiance(shots.scene, cell, led);
    ratio.push_back(predicted > 0.0 ? cell.radiance_W_per_mm2_sr / predicted : kNotSeen);
    if (std::isfinite(ratio.back())) {
      of_channel[static_cast<std::size_t>(cell.channel)].push_back(ratio.back());
    }
  }
  check.power_change_percent.setConstant(kNotSeen);
  Eigen::Array3d median = Eigen::Array3d::Constant(kNotSeen);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<double>& values = of_channel[c];
    if (values.empty()) continue;
    const double middle = upper_median(values);
    median[static_cast<Eigen::Index>(c)] = middle;
    check.power_change_percent[static_cast<Eigen::Index>(c)] = 100.0 * (middle - 1.0);
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    ratio[i] = ratio[i] / median[cells[i].channel] - 1.0;
  }
  double sum = 0.0, n = 0.0;
  for (const LedPlaneGrid& grid : shots.grids) {
    check.maps.push_back(plane_map(grid, cells, ratio));
    for (const double percent : check.maps.back().percent) {
      if (std::isnan(percent)) continue;
      sum += percent * percent;
      n += 1.0;
      check.plane_worst_percent = std::max(check.plane_worst_percent, std::abs(percent));
    }
  }
  check.plane_rms_percent = n > 0.0 ? std::sqrt(sum / n) : kNotSeen;
  if (n == 0.0) check.plane_worst_percent = kNotSeen;
}

}  // namespace

LedCheck check_led(const LedCalibrationInput& input, const std::string& light,
                   const LedFrames& frames) {
  LedCheck check;
  check.light = light;
  const LedShots shots = read_led_shots(input, light, frames);
  check.notes = shots.notes;
  check.highlight_names = shots.highlight_names;
  const PriorLed& prior = input.led(light);
  hold_highlights(prior.led, shots, check);
  LedFitOptions options;
  options.ambient = input.shots.ambient;
  const LedFit fit = fit_led(shots.scene, prior.led, options);
  hold_planes(prior.led, shots, fit, check);
  if (fit.status != LedStatus::kOk) {
    check.problem = fit.message;
    check.displacement_mm.setConstant(kNotSeen);
    check.displacement_covariance_mm2.setConstant(kNotSeen);
    check.displacement_length_mm = check.displacement_std_mm = check.displacement_stds = kNotSeen;
    check.exponent_change = check.axis_change_rad = kNotSeen;
    check.text = light + ": the shots do not determine its position: " + fit.message;
    return check;
  }
  check.displacement_mm = fit.led.position_mm - prior.led.position_mm;
  check.displacement_covariance_mm2 = fit.uncertainty.covariance.topLeftCorner<3, 3>() +
                                      uncertainty_of(prior).covariance.topLeftCorner<3, 3>();
  check.displacement_length_mm = check.displacement_mm.norm();
  const Eigen::Vector3d along = check.displacement_length_mm > 0.0
                                    ? check.displacement_mm.normalized().eval()
                                    : Eigen::Vector3d::UnitZ().eval();
  check.displacement_std_mm = std::sqrt(along.dot(check.displacement_covariance_mm2 * along));
  check.displacement_stds = std::sqrt(check.displacement_mm.dot(
      SymmetricSolver(check.displacement_covariance_mm2).solve(check.displacement_mm)));
  check.exponent_change = fit.led.exponent - prior.led.exponent;
  check.axis_change_rad =
      std::atan2(fit.led.axis.cross(prior.led.axis).norm(), fit.led.axis.dot(prior.led.axis));
  check.text = fmt::format("{} is {:.2f} +- {:.2f} mm from its position in the rig", light,
                           check.displacement_length_mm, check.displacement_std_mm);
  return check;
}

}  // namespace scattermeter::calib
