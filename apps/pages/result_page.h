// Results of a measurement as an HTML page.
#pragma once

#include <string>

#include "apps/instrument/measure.h"

namespace scattermeter::apps {

// A self-contained HTML page (html_page.h): all materials and channels with verdicts and reasons;
// for each material r(d) with error bars and the fitted models, the 95 % regions of sigma_s' and
// sigma_a, the estimates from single shots, the uncertainty budget, and observation, model and
// difference of the shots (if the measurement kept its rows). Without gnuplot, messages replace the
// plots.
std::string result_page(const Measurement& measurement, const std::string& command_line);

}  // namespace scattermeter::apps
