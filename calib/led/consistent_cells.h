// Which cells of white planes follow the model of one LED.
#pragma once

#include <vector>

#include "calib/led/led_scene.h"

namespace scattermeter::calib {

// One flag per cell: lit, and neither an outlier nor beside one. A cell is an outlier if its
// relative residual, measured / predicted - 1, exceeds `outlier_stds` times its noise, that noise
// scaled up to the bulk of all residuals (kStdPerMad times their median magnitude over the median
// noise) where the bulk is wider. The other channels of an outlier go with it, and the eight
// neighbouring cells of the shot where it is off by four times the limit: a shadow's edge reaches
// farther than it shows. `lit` (at least one) and `predicted_W_per_mm2_sr`: one per cell; cells
// that are not lit are never used.
std::vector<bool> consistent_cells(const LedScene& scene, const std::vector<bool>& lit,
                                   const std::vector<double>& predicted_W_per_mm2_sr,
                                   double outlier_stds);

}  // namespace scattermeter::calib
