// A slope that several groups of points have in common.
#pragma once

#include <vector>

#include "core/fit/shot_departure.h"

namespace scattermeter {

// Slope of y over x with a separate level for each group: groups of one point contribute nothing.
// std from the scatter about the lines (infinite without a remaining degree of freedom).
// Precondition (std::invalid_argument): the three are of one size.
Departure common_slope(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<int>& group);

}  // namespace scattermeter
