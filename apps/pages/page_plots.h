// Plots on an HTML page.
#pragma once

#include <string>
#include <vector>

#include "apps/pages/html_page.h"
#include "apps/report/plot.h"

namespace scattermeter::apps {

struct PagePlot {
  Plot plot;
  std::string caption;  // also the alternative text
};

// What apps/pages/web/plot.js draws: axes, series and colours as JSON, with six significant digits.
// Points with a coordinate that is not finite (or not positive on a log axis) are omitted; a value
// or a deviation that is not finite is null. "" if nothing is left to draw. Throws
// std::invalid_argument for lists of unequal length.
std::string plot_data(const Plot& plot);

// Figures of the plots. A plot without anything to draw is omitted.
Html plot_figures(const std::vector<PagePlot>& plots);

}  // namespace scattermeter::apps
