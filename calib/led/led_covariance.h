// Covariance of the least squares for an LED: data, nuisances and their priors together.
#pragma once

#include <set>

#include <Eigen/Core>

#include "calib/led/led_scene.h"
#include "calib/led/led_solver.h"
#include "core/light/led.h"
#include "core/light/led_uncertainty.h"

namespace scattermeter::calib {

struct LedCovariance {
  // The information matrix, scaled to a unit diagonal, has no eigenvalue of 1e-12 or below.
  bool determined = false;
  // Of all unknowns of LedSolution, with zero rows and columns for those that are not free; NaN if
  // not determined.
  Eigen::MatrixXd covariance;
  // If not determined: the combination of unknowns that the data leave open, each scaled by the
  // root of its own information, 0 for the nuisances. Otherwise empty.
  Eigen::VectorXd open_combination;
};

// The inverse of the total information: that of highlights and cells, each divided by its inflation
// of the variance (residual_inflation.h), plus that of the priors of the nuisances, which have unit
// standard deviation.
LedCovariance led_covariance(const LedScene& scene, const LedSolve& what,
                             const LedSolution& solution, double highlight_inflation,
                             double plane_inflation);

// Indices, among the unknowns of LedSolution, of the ambient light of those plane shots and
// channels for which it is free and cells are in use.
std::set<Eigen::Index> free_ambient_indices(const LedScene& scene, const LedSolve& what,
                                            const LedSolution& solution);

// The LED's part of `covariance` (LedCovariance::covariance, determined), with tangents about the
// axis of `led`. Its `common` is the response of the estimate to one standard deviation of the
// planes' albedo, and 0 unless `albedo_is_uncertain`.
LedUncertainty led_uncertainty(const Eigen::MatrixXd& covariance, const LedSolution& solution,
                               const Led& led, bool albedo_is_uncertain);

}  // namespace scattermeter::calib
