// Results of a measurement as an HTML page.
#pragma once

#include <string>

#include "apps/instrument/measure.h"

namespace scattermeter::apps {

// A self-contained HTML page (html_page.h): how well what was measured is known and what would help
// most, reasons of refusals, all materials and channels with verdicts, the rig in three dimensions;
// for each material its look as a cube and its colour as a plate, r(d) with error bars and the
// fitted models, the 95 % regions of sigma_s' and sigma_a, the uncertainty budget, the estimates
// from single shots, and observation, model and difference of the shots (if the measurement kept
// its rows).
std::string result_page(const Measurement& measurement, const std::string& command_line);

}  // namespace scattermeter::apps
