// Linearity and exposure times, jointly, from a series of flats.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/camera/response_curve.h"

namespace scattermeter::calib {

// Mean of one place (block and phase) in one flat.
struct FlatSample {
  std::size_t shot = 0;   // which flat
  std::size_t place = 0;  // which block
  double counts = 0;      // above black, as recorded; > 0
  // Variance of this mean: at 0 counts, and its growth per count (photon noise); the sum > 0. The
  // fit evaluates it at the counts that it predicts, lest samples that came out low weigh less.
  double variance_dark = 0;
  double variance_per_count = 0;
};

struct FlatShot {
  std::size_t setting = 0;  // which of the shutter's settings
};

struct ResponseFitOptions {
  std::size_t knots = 3;  // 1 .. 4, evenly spaced up to the brightest sample
  // Standard deviation of a stated time's relative error before the images are looked at. Cameras
  // round 1/64 s to 1/60 s: 6 % at the worst.
  double stated_time_std = 0.05;
  double black_std_counts = 0;  // of a shot's black: fitted along within this
  void Check() const;           // std::invalid_argument naming the field
};

struct ResponseFit {
  ResponseCurve curve;
  Eigen::MatrixXd curve_covariance;  // of the curve's log_ratio at its knots
  // Per setting: log of true over stated time, mean 0 over the settings; and their covariance.
  Eigen::VectorXd log_true_over_stated;
  Eigen::MatrixXd setting_covariance;
  // Of the settings' logs, then the knots' values: their errors largely cancel in the light of a
  // shot, log counts + G(counts) - e(setting).
  Eigen::MatrixXd joint_covariance;
  // Places x (settings, knots): how a place's log light below moves with these.
  Eigen::MatrixXd light_rows;
  // Per place: log of (light per stated second), the settings' mean error in it. NaN: never seen.
  std::vector<double> log_light_per_s;
  double shot_std = 0;  // by how much shots of one setting differ, relative (lamp, shutter)
  double rms = 0;       // of the samples' residuals, relative
  double worst_sigma = 0;
  double reduced_chi2 = 0;
  bool ok = false;  // false: fewer than three settings, or no place seen in more than one
};

// log(counts) = log L(place) + log t(setting) + e(setting) - G(counts) [+ black(shot) / counts]:
// linear in all that is unknown, the places eliminated. G and the weights are taken at the counts
// that the fit predicts, in five turns: at the counts as measured, whose noise is the values' own,
// G would be biased by far more than its uncertainty.
//
// Times and linearity alone cannot be told apart: any departure looks like wrong times. What
// separates them is that all places share the shutter while each has its own light: vignetting
// spreads a frame over many levels, and their ratios must not change with the exposure. What is
// assumed: one setting is always open equally long (pairs test that: shot_std), G is smooth (its
// polynomial of `knots` degrees, 0 without light), the lamp is steady. What remains weak is a power
// law, counts ~ light^(1 + epsilon), which no finite polynomial with G(0) = 0 follows; the series
// must span a factor of ten or more to exclude it. The covariance says what was reached.
// settings_s: stated times.
ResponseFit fit_response(const std::vector<FlatSample>& samples, const std::vector<FlatShot>& shots,
                         const std::vector<double>& settings_s, std::size_t n_places,
                         const ResponseFitOptions& options = {});

}  // namespace scattermeter::calib
