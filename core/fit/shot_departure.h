// Departures of single shots from the joint model of all.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/fit/linear_shot.h"

namespace scattermeter {

// A number with its standard deviation.
struct Departure {
  double value = 0;
  double std = 0;
};

// What an image of several shots is held against, linear about an optimum: l = predicted + jacobian
// x + nuisance_columns v + noise. Rows as in the system.
struct LinearModel {
  Eigen::VectorXd predicted;      // with every nuisance at its nominal value, W/mm^2
  Eigen::MatrixXd jacobian;       // by what is free: the medium's coefficients
  double scale_relative_std = 0;  // of the prior of the common scale; 0 exact, infinity free
};

struct ShotDepartures {
  // By shot. Its light relative to the joint model's, less the mean over the shots: an LED that
  // drifts, an aperture that moved. Of a single shot 0 with an infinite deviation.
  std::vector<Departure> power_relative;
  // By shot. Even light beside the lights of the model, relative to the shot's mean l: a lamp left
  // on. (On a body without hollows ambient light is nearly that, as all that enters leaves again.)
  std::vector<Departure> even_relative;
  // By nuisance of the system, in its unit: where the image puts it, its prior counted.
  std::vector<Departure> nuisances;
  // Of the residual that is left, per degree of freedom; where above 1 it widens all deviations.
  double reduced_chi2 = 0;
  // Residual of the joint model (nothing of a shot's own free but the nuisances), by shot, rms over
  // rms l.
  std::vector<double> residual_relative;
};

// Generalised least squares. Powers and even light are free within priors of `kWidest` each, far
// wider than what is looked for, so that what the shots cannot determine (all brighter, in a free
// scale) stays with the scale. Preconditions (std::invalid_argument): sizes agree, at least one
// shot.
inline constexpr double kWidest = 0.5;
ShotDepartures shot_departures(const DenseSystem& system, const LinearModel& model);

}  // namespace scattermeter
