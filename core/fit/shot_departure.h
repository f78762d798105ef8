// Departures of single shots from the joint model of all shots.
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

// A model of an image of several shots, linearised about an optimum: l = predicted + jacobian
// x + nuisance_columns v + noise. Rows as in the system.
struct LinearModel {
  Eigen::VectorXd predicted;      // with every nuisance at its nominal value, W/mm^2
  Eigen::MatrixXd jacobian;       // by the free parameters: the medium's coefficients
  double scale_relative_std = 0;  // of the prior of the common scale; 0 exact, infinity free
};

struct ShotDepartures {
  // By shot: its light relative to the joint model's, minus the mean over the shots (an LED that
  // drifts, an aperture that moved). For a single shot, 0 with an infinite deviation.
  std::vector<Departure> power_relative;
  // By shot: uniform light in addition to the model's lights, relative to the shot's mean l (a lamp
  // left on; on a convex body, ambient light is nearly uniform, as all light that enters leaves
  // again).
  std::vector<Departure> even_relative;
  // By nuisance of the system, in its unit: its estimate from the image and its prior.
  std::vector<Departure> nuisances;
  // Of the remaining residual, per degree of freedom; above 1 it widens all standard deviations.
  double reduced_chi2 = 0;
  // By shot: residual of the joint model (without departures; nuisances fitted), rms over rms l.
  std::vector<double> residual_relative;
};

// Generalised least squares. Powers and uniform light are free within priors of `kWidest` each, far
// wider than the departures of interest, so that what the shots cannot determine (a common factor,
// if the scale is free) is attributed to the scale. Preconditions (std::invalid_argument): sizes
// agree, at least one shot.
inline constexpr double kWidest = 0.5;
ShotDepartures shot_departures(const DenseSystem& system, const LinearModel& model);

}  // namespace scattermeter
