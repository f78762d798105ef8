// Starting points of an LED's fit, to be tried one after the other.
#pragma once

#include <vector>

#include "calib/led/led_scene.h"
#include "calib/led/led_solver.h"
#include "core/light/led.h"

namespace scattermeter::calib {

// Starts about `led` for a fit of the data that `what` uses: its axis (unless that points away from
// the data, cosine below 0.3) and one towards the data's centre. Where the position is not known
// from highlights, since shading alone tells distance from power only weakly, the same at 0.75 and
// 1.35 times the distance as well. Exponents are at least 0.5; intensities make the median cell of
// each lit channel right, and a start is left out where the LED would not light half of a channel's
// cells. Channels of no intensity keep it. At least one datum must be in use.
std::vector<Led> start_candidates(const LedScene& scene, const LedSolve& what, const Led& led,
                                  bool position_is_known);

}  // namespace scattermeter::calib
