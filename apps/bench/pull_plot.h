// How many standard deviations the answers are off.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/report/plot.h"

namespace scattermeter::apps {

// The distribution of named sets of pulls, (answer - truth) / standard deviation, as densities with
// their counting errors, beside the standard normal that they follow where the uncertainty is
// right. Bins of half a deviation from -5 to 5; what lies beyond is counted in the outermost, NaN
// nowhere.
Plot pull_plot(const std::string& title,
               const std::vector<std::pair<std::string, std::vector<double>>>& pulls);

}  // namespace scattermeter::apps
