// Excess scatter of the residuals of an LED fit over their noise.
#pragma once

#include <vector>

#include "calib/led/led_scene.h"

namespace scattermeter::calib {

// Mean square of `n` normalised residuals, chi2 / (n - parameters), if it exceeds 1, the value for
// pure noise, by more than three of its standard deviations; otherwise 1, also with less than one
// degree of freedom.
double residual_inflation(double chi2, double n, double parameters);

// The same for the cells in use: the largest value over blocks of 1, 3 x 3 and 6 x 6 cells of one
// channel of a shot. Errors common to neighbouring cells are visible in the larger blocks. At most
// half of the degrees of freedom of each block size are attributed to parameters.
// `predicted_W_per_mm2_sr` and `use` have one entry per cell.
double cell_inflation(const LedScene& scene, const std::vector<double>& predicted_W_per_mm2_sr,
                      const std::vector<bool>& use, double parameters);

}  // namespace scattermeter::calib
