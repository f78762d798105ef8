// Fit of an LED's position, lobe and power to shots of mirror spheres and white planes.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_scene.h"
#include "core/light/led.h"
#include "core/light/led_uncertainty.h"

namespace scattermeter::calib {

// Model of the light on the white planes that does not come from the LED, unless it was subtracted
// (LedScene::ambient_subtracted): a constant >= 0 for each plane shot and channel.
enum class AmbientModel {
  kWhereSeen,  // none, unless the cells contradict that but agree with a constant
  kFitted,     // always one
  kNone,       // never one
};

struct LedFitOptions {
  double inlier_px = 3.0;     // a highlight farther from its prediction by the others is left out
  double outlier_stds = 6.0;  // a cell farther from the model than this many standard deviations
                              // of the bulk is left out, with its neighbours
  double max_left_out = 0.4;  // share of a plane's cells; with more the status is kMisfit
  // Without a plane, axis, exponent and intensity keep their start values, with these standard
  // deviations.
  double axis_std_rad = 0;
  double exponent_std = 0;
  double log_intensity_std = 0;
  AmbientModel ambient = AmbientModel::kWhereSeen;
  void Check() const;  // std::invalid_argument naming the field
};

// Each status with its condition, in the order in which they are checked.
enum class LedStatus {
  kOk,
  // There are no cells of a plane, and fewer than two highlights agree on a position.
  kTooFewData,
  // The least squares did not converge.
  kNotConverged,
  // More than max_left_out of a plane's cells do not follow the model.
  kMisfit,
  // The data leave a combination of the unknowns open: the information matrix, scaled to a unit
  // diagonal, has an eigenvalue below 1e-12.
  kUndetermined,
  // The position is uncertain by more than 5 % of the distance, the axis by more than 0.1 rad, or
  // the exponent by more than 0.3 (relative, if it exceeds 1): beyond these limits the linearised
  // covariance is not valid.
  kIllConditioned,
};

// Fitted ambient light of a plane shot, absolute and relative to the LED's light (median of its
// cells). NaN for channels without light from the LED.
struct FittedAmbient {
  std::size_t shot = 0;  // ShadedCell::shot
  Eigen::Array3d radiance_W_per_mm2_sr;
  Eigen::Array3d relative;
  Eigen::Array3d relative_std;
};

struct LedFit {
  LedStatus status = LedStatus::kTooFewData;
  std::string message;                // what is wrong and what to do; "" if ok
  std::vector<std::string> warnings;  // only if ok
  // The members below are valid if ok, and for inspection only if kMisfit, kUndetermined or
  // kIllConditioned.
  Led led;
  LedUncertainty uncertainty;
  bool lobe_fitted = false;  // a plane was seen: axis, exponent and intensity are from the data
  double distance_mm = 0;    // to LedScene::data_center_mm()
  double distance_std_mm = 0;
  double distance_power_correlation = 0;  // of log distance and log intensity; 0 without a plane
  // For each highlight, outliers included: predicted - measured, px; NaN if it has no image.
  std::vector<Eigen::Vector2d> highlight_residuals_px;
  std::vector<bool> highlight_used;
  // For each cell, outliers included: measured / predicted - 1.
  std::vector<double> cell_residuals;
  std::vector<bool> cell_used;
  double highlight_rms_px = 0, highlight_worst_px = 0;  // of those used, length of the 2-vector
  double plane_rms = 0, plane_worst = 0;                // relative, of those used
  // Plane shots with fitted ambient light. The covariance of the LED includes its uncertainty.
  std::vector<FittedAmbient> ambient;
  // Factors (>= 1) by which the variance of the data exceeds that of their noise; included in the
  // covariance.
  double highlight_inflation = 1, plane_inflation = 1;
};

// A robust start (the position from the highlights if two agree, else several starts about `start`)
// is followed by joint least squares over highlights and cells, with the nuisances of LedScene
// within their priors and without cells that do not follow the model (dust, shadows). The
// covariance is derived from the Jacobian at the solution and includes noise, poses, spheres and
// albedo. If residuals scatter more than their noise explains, singly or as means over blocks of 3
// x 3 and 6 x 6 cells, the contribution of the data is widened by that ratio.
// With AmbientModel::kWhereSeen the fit is made without constants and, if there is such scatter,
// repeated with constants; ambient_is_seen() (calib/led/led_ambient.h) decides which of the two
// fits the cells require. A layout that cannot separate the LED from the constant is then refused
// like any other insufficient layout. `start`: radius_mm is used unchanged; the position may be
// wrong by a fifth of the distance, axis and exponent by much more. An insufficient layout is
// reported by the status, never by an exception. Deterministic.
LedFit fit_led(const LedScene& scene, const Led& start, const LedFitOptions& options = {});

}  // namespace scattermeter::calib
