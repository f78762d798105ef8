// By how much the residuals of an LED's fit scatter beyond their noise.
#pragma once

#include <vector>

#include "calib/led/led_scene.h"

namespace scattermeter::calib {

// Mean square of `n` normalised residuals, chi2 / (n - parameters), where it exceeds the 1 of pure
// noise by more than three of its own standard deviations; else 1, and 1 with less than one degree
// of freedom.
double residual_inflation(double chi2, double n, double parameters);

// The same for the cells in use, and the largest of it over blocks of 1, 3 x 3 and 6 x 6 cells of
// one channel of a shot: errors that neighbours share show in the larger ones. At most half of the
// degrees of freedom of each size are taken for parameters. `predicted_W_per_mm2_sr`, `use`: one
// per cell.
double cell_inflation(const LedScene& scene, const std::vector<double>& predicted_W_per_mm2_sr,
                      const std::vector<bool>& use, double parameters);

}  // namespace scattermeter::calib
