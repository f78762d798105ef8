// What `measure` found, to look at.
#pragma once

#include <string>

#include "apps/measure.h"

namespace scattermeter::apps {

// A self-contained HTML page (html_page.h): all materials and channels with verdicts and reasons;
// for each material r(d) with error bars and the fitted models, the 95 % regions of sigma_s' and
// sigma_a, each shot's own answer, the uncertainty budget, and observed, model and difference on
// the shots (where the measurement kept its rows). Where gnuplot is missing, sentences stand in
// place of the plots.
std::string result_page(const Measurement& measurement, const std::string& command_line);

}  // namespace scattermeter::apps
