// The least squares behind fit_led().
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_scene.h"
#include "core/light/led.h"
#include "core/light/led_uncertainty.h"

namespace scattermeter::calib {

// Which of the scene's data and of the LED's parameters take part.
struct LedSolve {
  std::vector<bool> use_highlight;          // one per highlight
  std::vector<bool> use_cell;               // one per cell
  std::array<bool, kLedParameters> free{};  // the others stay as they are
  // Plane shots (ShadedCell::shot) with a constant ambient radiance >= 0 of each channel of their
  // own; the others have none. Empty: no shot has one.
  std::vector<bool> free_ambient;
  // Added to the noise of a cell in quadrature, relative to its radiance.
  double cell_relative_std = 0;
  // Cells by Cauchy's loss log(1 + r^2): outliers then pull little. Meant for starts: tolerances
  // are loose and the information is left empty.
  bool robust = false;
};

struct LedSolution {
  bool converged = false;
  Led led;
  double cost = 0;
  // Predictions at the solution, with the nuisances at their best: one per highlight (px) and cell
  // (W/(mm^2 sr)), used or not; NaN where there is none.
  std::vector<Eigen::Vector2d> highlight_px;
  std::vector<double> cell_radiance;
  // By plane shot, W/(mm^2 sr); part of cell_radiance.
  std::vector<Eigen::Array3d> ambient;
  // J^T S^-1 J of highlights and cells in use, apart, over all unknowns: the LED's 9 (rows of what
  // is not free are 0; axis by the tangents below), from `ambient_at` per plane shot 3 (in units of
  // ambient_unit; 0 where not free), from `nuisances_at` per view 6, per sphere 4, per exposure
  // setting 1 and one more, 1 albedo: the nuisances, each in units of its own prior's standard
  // deviation.
  Eigen::Index ambient_at = kLedParameters;
  Eigen::Index nuisances_at = kLedParameters;
  std::vector<Eigen::Array3d> ambient_unit;  // by plane shot, W/(mm^2 sr): the mean of its cells
  Eigen::MatrixXd highlight_information;
  Eigen::MatrixXd cell_information;
  std::array<Eigen::Vector3d, 2> tangents;
};

// Levenberg-Marquardt (Ceres) from `start`. Model: highlights by highlight_px(), cells by CellModel
// plus the shot's ambient light, with the poses of the views, centres and radii of the spheres,
// exposure times and the albedo as nuisances within their priors. With an intensity of 0 a
// channel's log must not be free.
LedSolution solve_led(const LedScene& scene, const Led& start, const LedSolve& what);

}  // namespace scattermeter::calib
