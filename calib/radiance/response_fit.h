// Joint fit of linearity and exposure times to a series of flats.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/camera/response_curve.h"

namespace scattermeter::calib {

// Mean of one place (a block under one lamp) in one flat.
struct FlatSample {
  std::size_t shot = 0;   // index of the flat
  std::size_t place = 0;  // index of the place
  double counts = 0;      // above black, as recorded; > 0
  // Variance of this mean at 0 counts, and its increase per count (photon noise); the total is > 0.
  // The fit evaluates it at the predicted counts, so that the weight does not depend on the noise
  // of the sample.
  double variance_dark = 0;
  double variance_per_count = 0;
};

struct FlatShot {
  std::size_t setting = 0;  // index of the setting of the shutter
};

struct ResponseFitOptions {
  std::size_t knots = 3;  // 1 .. 4, evenly spaced up to the brightest sample
  // Prior standard deviation of the relative error of a stated time. Cameras round 1/64 s to 1/60
  // s: 6 % at worst.
  double stated_time_std = 0.05;
  double black_std_counts = 0;  // of the black of a shot, which is fitted within this
  void Check() const;           // std::invalid_argument naming the field
};

struct ResponseFit {
  ResponseCurve curve;
  Eigen::MatrixXd curve_covariance;  // of log_ratio of the curve at its knots
  // For each setting the log of true over stated time, with mean 0 over the settings; and their
  // covariance.
  Eigen::VectorXd log_true_over_stated;
  Eigen::MatrixXd setting_covariance;
  // Of the logs of the settings, then of the values at the knots: their errors largely cancel in
  // the light of a shot, log counts + G(counts) - e(setting).
  Eigen::MatrixXd joint_covariance;
  // Places x (settings, knots): derivative of the log light of each place, below, by these.
  Eigen::MatrixXd light_rows;
  // For each place the log of light per stated second, which includes the mean error of the
  // settings. NaN: never measured.
  std::vector<double> log_light_per_s;
  double shot_std = 0;  // relative scatter of shots of one setting (lamp, shutter)
  double rms = 0;       // of the relative residuals of the samples
  double worst_sigma = 0;
  double reduced_chi2 = 0;
  bool ok = false;  // false: fewer than three settings, or no place measured in more than one
};

// log(counts) = log L(place) + log t(setting) + e(setting) - G(counts) [+ black(shot) / counts]:
// linear in all unknowns, of which log L(place) is eliminated. G and the weights are evaluated at
// the predicted counts, in five iterations: evaluated at the measured counts, with their noise, G
// would be biased by far more than its uncertainty.
//
// Times and linearity cannot be separated at a single light level, where any departure looks like
// wrong times. They are separated because all places have the same exposure time but different
// light: vignetting spreads a frame over many levels, and their ratios must not change with the
// exposure. Assumptions: the true time of a setting is reproducible (tested by pairs, see
// shot_std), G is smooth (a polynomial of degree `knots` that is 0 without light), and the lamp is
// steady. A power law, counts ~ light^(1 + epsilon), is determined only weakly: no finite
// polynomial with G(0) = 0 follows it, and the series must span a factor of ten or more to exclude
// it. The covariance includes this. settings_s: stated times.
ResponseFit fit_response(const std::vector<FlatSample>& samples, const std::vector<FlatShot>& shots,
                         const std::vector<double>& settings_s, std::size_t n_places,
                         const ResponseFitOptions& options = {});

}  // namespace scattermeter::calib
