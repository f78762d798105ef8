// The covariance of an LED's least squares: data, nuisances and their priors together.
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
  // Over all unknowns of LedSolution, rows and columns of what is not free 0; NaN where not
  // determined.
  Eigen::MatrixXd covariance;
  // Where not determined: the combination of unknowns that the data leave open, in units of each
  // one's own information; 0 for the nuisances. Else empty.
  Eigen::VectorXd open_combination;
};

// Inverse of the information of highlights and cells, each divided by its inflation of the
// variance (residual_inflation.h), plus the nuisances' priors of unit deviation.
LedCovariance led_covariance(const LedScene& scene, const LedSolve& what,
                             const LedSolution& solution, double highlight_inflation,
                             double plane_inflation);

// Indices among LedSolution's unknowns of the ambient light of those plane shots and channels that
// have it free and cells in use.
std::set<Eigen::Index> free_ambient_indices(const LedScene& scene, const LedSolve& what,
                                            const LedSolution& solution);

// The LED's part of `covariance` (LedCovariance::covariance, determined), about the axis of `led`.
// `common` is 0 unless `albedo_is_uncertain`: the response of the estimate to one standard
// deviation of the planes' albedo.
LedUncertainty led_uncertainty(const Eigen::MatrixXd& covariance, const LedSolution& solution,
                               const Led& led, bool albedo_is_uncertain);

}  // namespace scattermeter::calib
