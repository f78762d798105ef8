// Least squares for fit_led().
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_scene.h"
#include "core/light/led.h"
#include "core/light/led_uncertainty.h"

namespace scattermeter::calib {

// The data of the scene that are used, and the parameters of the LED that are fitted.
struct LedSolve {
  std::vector<bool> use_highlight;          // one per highlight
  std::vector<bool> use_cell;               // one per cell
  std::array<bool, kLedParameters> free{};  // the others are fixed
  // Plane shots (ShadedCell::shot) with a fitted ambient radiance >= 0 for each channel; the others
  // have none. Empty: no shot has one.
  std::vector<bool> free_ambient;
  // Added in quadrature to the noise of a cell, relative to its radiance.
  double cell_relative_std = 0;
  // Uses Cauchy's loss log(1 + r^2) for the cells, so that outliers have little influence. Meant
  // for starts: tolerances are loose and the information is left empty.
  bool robust = false;
};

struct LedSolution {
  bool converged = false;
  Led led;
  double cost = 0;
  // Predictions at the solution with the fitted nuisances, for each highlight (px) and cell
  // (W/(mm^2 sr)), used or not; NaN if there is none.
  std::vector<Eigen::Vector2d> highlight_px;
  std::vector<double> cell_radiance;
  // For each plane shot, W/(mm^2 sr); included in cell_radiance.
  std::vector<Eigen::Array3d> ambient;
  // J^T S^-1 J, separately of the highlights and the cells in use, over all unknowns: the 9 of the
  // LED (rows of fixed parameters are 0; axis along the tangents below); from `ambient_at` on, 3
  // for each plane shot (in units of ambient_unit; 0 if fixed); from `nuisances_at` on, the
  // nuisances, each in units of the standard deviation of its prior: 6 for each view, 4 for each
  // sphere, 1 for each exposure setting and one more, 1 for the albedo.
  Eigen::Index ambient_at = kLedParameters;
  Eigen::Index nuisances_at = kLedParameters;
  std::vector<Eigen::Array3d> ambient_unit;  // per plane shot, W/(mm^2 sr): the mean of its cells
  Eigen::MatrixXd highlight_information;
  Eigen::MatrixXd cell_information;
  std::array<Eigen::Vector3d, 2> tangents;
};

// Levenberg-Marquardt (Ceres) from `start`. The model predicts highlights by highlight_px() and
// cells by CellModel plus the ambient light of the shot; the poses of the views, centres and radii
// of the spheres, exposure times and the albedo are nuisances within their priors. The log
// intensity of a channel must not be free if its intensity is 0.
LedSolution solve_led(const LedScene& scene, const Led& start, const LedSolve& what);

}  // namespace scattermeter::calib
