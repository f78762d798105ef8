// Starting points for the fit of an LED, to be tried one after the other.
#pragma once

#include <vector>

#include "calib/led/led_scene.h"
#include "calib/led/led_solver.h"
#include "core/light/led.h"

namespace scattermeter::calib {

// Starts about `led` for a fit to the data that `what` uses: one with its axis (unless that points
// away from the data, cosine below 0.3) and one with an axis towards the centre of the data. If the
// position is not known from highlights, both are also tried at 0.75 and 1.35 times the distance,
// since shading alone separates distance from power only weakly. Exponents are at least 0.5;
// intensities are such that the median cell of each lit channel is matched. A start is left out if
// its LED would not light half of the cells of a channel. A channel without intensity remains so
// and must have no cell in use. At least one datum must be in use.
std::vector<Led> start_candidates(const LedScene& scene, const LedSolve& what, const Led& led,
                                  bool position_is_known);

}  // namespace scattermeter::calib
