#include "calib/led/led_verdict.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/base/symmetric_eigen.h"

namespace scattermeter::calib {
namespace {

// Standard deviation of the power (mean log intensity of the free channels) and its correlation
// with the distance along the unit vector `towards`; 0 if the lobe was not fitted.
double power_std(const LedSolve& what, const Eigen::Vector3d& towards, LedFit& fit) {
  if (!fit.lobe_fitted) return 0.0;
  const LedMatrix& c = fit.uncertainty.covariance;
  Eigen::Vector3d share = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    if (what.free[kLedLogIntensity + k]) share[static_cast<Eigen::Index>(k)] = 1.0;
  }
  share /= share.sum();
  const double std =
      std::sqrt(share.dot(c.block<3, 3>(kLedLogIntensity, kLedLogIntensity) * share));
  fit.distance_power_correlation =
      towards.dot(c.block<3, 3>(0, kLedLogIntensity) * share) / (fit.distance_std_mm * std);
  return std;
}

void add_warnings(const LedFitOptions& options, const std::string& tied, LedFit& fit) {
  if (!tied.empty() && fit.distance_std_mm / fit.distance_mm > 0.003) fit.warnings.push_back(tied);
  if (!fit.lobe_fitted) {
    fit.warnings.emplace_back(
        "no white plane was seen: axis, exponent and intensity stay as the rig says");
  }
  if (fit.lobe_fitted && fit.led.exponent == fit.led.least_exponent()) {
    fit.warnings.push_back(
        fmt::format("the exponent lies at its bound of {}", fit.led.least_exponent()));
  }
  const auto out = std::count(fit.highlight_used.begin(), fit.highlight_used.end(), false);
  if (out > 0) {
    fit.warnings.push_back(
        fmt::format("{} highlight(s) do not fit the others and were left out", out));
  }
  if (fit.plane_inflation > 4.0) {
    fit.warnings.push_back(fmt::format(
        "the plane's shading departs from the model by {:.3g} % rms, beyond its noise; the "
        "covariance is widened {:.3g} times{}",
        100.0 * fit.plane_rms, fit.plane_inflation,
        options.ambient == AmbientModel::kNone
            ? "; if the room was not dark, do not set calibration.led.ambient to none"
            : ""));
  }
}

}  // namespace

void refuse_led(LedFit& fit, LedStatus status, const std::string& message) {
  fit.status = status;
  fit.message = message;
  fit.warnings.clear();
}

std::string combination_name(const Eigen::VectorXd& v) {
  std::string names;
  const auto add = [&](const std::string& name, double weight) {
    if (weight < 0.05) return;
    names += (names.empty() ? "" : ", ") + name;
  };
  const double all = v.squaredNorm();
  add("position", v.head<3>().squaredNorm() / all);
  add("axis", v.segment<2>(kLedAxis).squaredNorm() / all);
  add("exponent", v[kLedExponent] * v[kLedExponent] / all);
  add("power", v.segment<3>(kLedLogIntensity).squaredNorm() / all);
  add("ambient light", v.tail(v.size() - kLedParameters).squaredNorm() / all);
  return names.empty() ? "position" : names;
}

std::string layout_advice(const LedSolve& what) {
  const bool ambient = std::any_of(what.free_ambient.begin(), what.free_ambient.end(),
                                   [](bool free) { return free; });
  return std::string(ambient ? "shoot the planes with the LED off as well, " : "") +
         "add spheres, a plane nearer to the LED or at another height, or a tilted one";
}

void judge_led(const LedScene& scene, const LedSolve& what, const LedFitOptions& options,
               LedFit& fit) {
  const LedMatrix& c = fit.uncertainty.covariance;
  const Eigen::Vector3d away =
      fit.led.position_mm - scene.data_center_mm(what.use_cell, what.use_highlight);
  fit.distance_mm = away.norm();
  // Spheres known to 0.01 mm and a highlight's centre scatter by some tenths.
  constexpr double kMostHighlight_px = 1.0;
  if (fit.highlight_rms_px > kMostHighlight_px) {
    refuse_led(fit, LedStatus::kMisfit,
               fmt::format("no position of the LED fits its highlights and planes: the highlights "
                           "used are {:.2g} px off (rms); see that each shot is listed for the LED "
                           "that was on, and check centres and radii (not diameters) of the "
                           "spheres and the positions of the planes",
                           fit.highlight_rms_px));
    return;
  }
  const Eigen::Vector3d towards = away / fit.distance_mm;
  fit.distance_std_mm = std::sqrt(towards.dot(c.topLeftCorner<3, 3>() * towards));
  const double power = power_std(what, towards, fit);
  const std::string together = fmt::format(
      "distance known to {:.3g} mm of {:.3g}, power to {:.3g} %, correlation {:.3g}",
      fit.distance_std_mm, fit.distance_mm, 100.0 * power, fit.distance_power_correlation);
  const double position_std = std::sqrt(symmetric_eigen(c.topLeftCorner<3, 3>()).values[2]);
  const double axis_std = std::sqrt(std::max(c(kLedAxis, kLedAxis), c(kLedAxis + 1, kLedAxis + 1)));
  const double exponent_std = std::sqrt(c(kLedExponent, kLedExponent));
  const bool tied = fit.lobe_fitted && std::abs(fit.distance_power_correlation) > 0.95;
  if (position_std > 0.05 * fit.distance_mm) {
    const std::string what_is_open =
        tied ? "the layout cannot separate the LED's distance from its power (" + together + "); "
             : fmt::format("the position is known to {:.3g} mm only; ", position_std);
    refuse_led(fit, LedStatus::kIllConditioned, what_is_open + layout_advice(what));
    return;
  }
  if (axis_std > 0.1 || (fit.lobe_fitted && exponent_std > 0.3 * std::max(1.0, fit.led.exponent))) {
    refuse_led(fit, LedStatus::kIllConditioned,
               fmt::format("the axis is known to {:.3g} rad and the exponent to {:.3g} only: the "
                           "plane shows too little of the lobe; {}",
                           axis_std, exponent_std, layout_advice(what)));
    return;
  }
  fit.status = LedStatus::kOk;
  add_warnings(options,
               tied ? "the layout hardly separates distance from power: " + together + "; " +
                          layout_advice(what)
                    : "",
               fit);
}

}  // namespace scattermeter::calib
