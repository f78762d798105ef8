// A slope common to several groups of points.
#pragma once

#include <vector>

#include "core/fit/shot_departure.h"

namespace scattermeter {

// Slope of y over x with a separate level for each group; groups of one point contribute nothing.
// std is from the scatter about the lines (infinite without a remaining degree of freedom).
// Precondition (std::invalid_argument): the arguments have equal sizes.
Departure common_slope(const std::vector<double>& x, const std::vector<double>& y,
                       const std::vector<int>& group);

}  // namespace scattermeter
