// Light on white planes that does not come from the LED.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calib/led/led_fit.h"
#include "calib/led/led_scene.h"
#include "calib/led/led_solver.h"
#include "calib/led/plane_cells.h"

namespace scattermeter::calib {

// What a solution found of the ambient light of each plane shot that has it free. `covariance`:
// over all unknowns of the solution (LedCovariance).
std::vector<FittedAmbient> fitted_ambient(const LedScene& scene, const LedSolve& what,
                                          const LedSolution& solution,
                                          const Eigen::MatrixXd& covariance);

// Whether the cells ask for the constants of `with`, a fit of the same scene as `without`, which
// has none: on the cells that both use, chi^2 falls by more than chance would let it, p below 1e-6
// with as many degrees of freedom as there are constants. The fall counts over plane_inflation of
// `with`, so that what no constant explains is no evidence of one. False where a fit has no
// residuals.
bool ambient_is_seen(const LedScene& scene, const LedFit& without, const LedFit& with);

// The cells less those of the same plane with the LED off, variances added; cells that `ambient`
// lacks are left out. The grids may differ (another pose of the camera): a cell then takes the one
// that its middle lies in. Precondition: ambient.cells are of one plane shot.
PlaneCells without_ambient(const PlaneCells& lit, const PlaneCells& ambient);

}  // namespace scattermeter::calib
