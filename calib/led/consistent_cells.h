// Selection of the cells of white planes that follow the model of one LED.
#pragma once

#include <vector>

#include "calib/led/led_scene.h"

namespace scattermeter::calib {

// One flag per cell: lit, and neither an outlier nor next to one. A cell is an outlier if its
// relative residual, measured / predicted - 1, exceeds `outlier_stds` times its noise, scaled up to
// the bulk of all residuals (kStdPerMad times their median magnitude over the median noise) if that
// is larger. With an outlier the other channels of its cell are left out, and beyond four times the
// limit the eight neighbouring cells of the shot as well, since the edge of a shadow extends
// farther than is visible. `lit` (at least one) and `predicted_W_per_mm2_sr` have one entry per
// cell; cells that are not lit are never used.
std::vector<bool> consistent_cells(const LedScene& scene, const std::vector<bool>& lit,
                                   const std::vector<double>& predicted_W_per_mm2_sr,
                                   double outlier_stds);

}  // namespace scattermeter::calib
