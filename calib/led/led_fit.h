// An LED's position, lobe and power from mirror spheres and white planes.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_scene.h"
#include "core/light/led.h"
#include "core/light/led_uncertainty.h"

namespace scattermeter::calib {

// Light on the white planes that does not come from the LED, where it was not subtracted
// (LedScene::ambient_subtracted): a constant >= 0 of each plane shot and channel.
enum class AmbientModel {
  kWhereSeen,  // there is none, unless the cells contradict that and not the constant
  kFitted,     // always one
  kNone,       // never one
};

struct LedFitOptions {
  double inlier_px = 3.0;     // a highlight farther from where the others put the LED is left out
  double outlier_stds = 6.0;  // a cell farther from the model than this many standard deviations
                              // of the bulk is left out, with its neighbours
  double max_left_out = 0.4;  // share of a plane's cells; with more, nothing is concluded
  // Without a plane, axis, exponent and intensity stay as the start has them, known to these.
  double exponent_std = 0;
  double log_intensity_std = 0;
  AmbientModel ambient = AmbientModel::kWhereSeen;
  void Check() const;  // std::invalid_argument naming the field
};

// Each by its condition, in the order in which they are looked for.
enum class LedStatus {
  kOk,
  // No cell of a plane, and fewer than two highlights that agree on a position.
  kTooFewData,
  // The least squares did not settle.
  kNotConverged,
  // More than max_left_out of a plane's cells do not follow the model.
  kMisfit,
  // The data leave a combination of the unknowns open: the information matrix, scaled to a unit
  // diagonal, has an eigenvalue below 1e-12.
  kUndetermined,
  // The position is uncertain by more than 5 % of the distance, the axis by more than 0.1 rad, or
  // the exponent by more than 0.3 (of itself, where it exceeds 1): beyond that the linearised
  // covariance is not true.
  kIllConditioned,
};

// Fitted ambient light of a plane shot over the LED's own, the median of its cells. NaN for
// channels without the LED's light.
struct FittedAmbient {
  std::size_t shot = 0;  // ShadedCell::shot
  Eigen::Array3d radiance_W_per_mm2_sr;
  Eigen::Array3d relative;
  Eigen::Array3d relative_std;
};

struct LedFit {
  LedStatus status = LedStatus::kTooFewData;
  std::string message;                // what is wrong and what to do; "" if ok
  std::vector<std::string> warnings;  // of a fit that is ok
  // From here on: valid if ok, for inspection where kMisfit, kUndetermined or kIllConditioned.
  Led led;
  LedUncertainty uncertainty;
  bool lobe_fitted = false;  // a plane was seen: axis, exponent and intensity are the data's
  double distance_mm = 0;    // to the middle of what was seen
  double distance_std_mm = 0;
  double distance_power_correlation = 0;  // of log distance and log intensity; 0 without a plane
  // Per highlight: predicted - measured, px; NaN where it has no image. Outliers too.
  std::vector<Eigen::Vector2d> highlight_residuals_px;
  std::vector<bool> highlight_used;
  // Per cell: measured / predicted - 1. Outliers too.
  std::vector<double> cell_residuals;
  std::vector<bool> cell_used;
  double highlight_rms_px = 0, highlight_worst_px = 0;  // of those used, the 2-vector's length
  double plane_rms = 0, plane_worst = 0;                // relative, of those used
  // By plane shot, without those that have none. Its part of the uncertainty is in the covariance.
  std::vector<FittedAmbient> ambient;
  // By how much the data scatter beyond their noise; the covariance holds them (>= 1).
  double highlight_inflation = 1, plane_inflation = 1;
};

// Robust start (the position from the highlights where two agree, else several about `start`), then
// least squares over highlights and cells at once, cells that do not follow (dust, shadows) left
// out, with the nuisances of LedScene within their priors. Covariance from the Jacobian there:
// noise, poses, spheres and albedo. Where residuals scatter more than their noise allows, alone or
// as means over blocks of 3 x 3 and 6 x 6 cells, the data's part is widened by that ratio.
// Ambient light kWhereSeen: fitted without and, where that scatter shows, with constants too, and
// ambient_is_seen() (calib/led/led_ambient.h) says which of the two the cells ask for: a layout
// that cannot separate the LED from the constant is then refused as any other that says too little.
// `start`: radius_mm is taken as it is; the position may be wrong by a fifth of the distance, axis
// and exponent by much. Layouts that say too little are a status, never an exception.
// Deterministic.
LedFit fit_led(const LedScene& scene, const Led& start, const LedFitOptions& options = {});

}  // namespace scattermeter::calib
