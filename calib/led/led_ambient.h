// Ambient light: light on white planes that does not come from the LED.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calib/led/led_fit.h"
#include "calib/led/led_scene.h"
#include "calib/led/led_solver.h"
#include "calib/led/plane_cells.h"

namespace scattermeter::calib {

// The fitted ambient light of each plane shot for which a solution has it free. `covariance` is
// that of all unknowns of the solution (LedCovariance).
std::vector<FittedAmbient> fitted_ambient(const LedScene& scene, const LedSolve& what,
                                          const LedSolution& solution,
                                          const Eigen::MatrixXd& covariance);

// Whether the cells require the ambient constants of `with`, a fit of the same scene as `without`,
// which has none: on the cells that both use, chi^2 decreases by more than chance explains (p below
// 1e-6, one degree of freedom per constant). The decrease is divided by plane_inflation of `with`,
// so that residuals that no constant explains are no evidence of one. False if a fit has no
// residuals.
bool ambient_is_seen(const LedScene& scene, const LedFit& without, const LedFit& with);

// The cells minus those of the same plane with the LED off, with variances added; cells that
// `ambient` lacks are left out. The grids may differ (another camera pose): the cell subtracted is
// the one that contains the centre of the lit cell. Precondition: ambient.cells are of one plane
// shot.
PlaneCells without_ambient(const PlaneCells& lit, const PlaneCells& ambient);

}  // namespace scattermeter::calib
