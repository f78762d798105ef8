// Plot of errors in standard deviations.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "apps/report/plot.h"

namespace scattermeter::apps {

// The distributions of named sets of pulls, (estimate - truth) / standard deviation, as densities
// with counting errors, and the standard normal distribution that they follow if the uncertainty is
// right. Bins are half a standard deviation wide, from -5 to 5; the outermost include values
// beyond. NaN is ignored.
Plot pull_plot(const std::string& title,
               const std::vector<std::pair<std::string, std::vector<double>>>& pulls);

}  // namespace scattermeter::apps
