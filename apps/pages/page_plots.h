// Plots on an HTML page.
#pragma once

#include <string>
#include <vector>

#include "apps/pages/html_page.h"
#include "apps/report/plot.h"

namespace scattermeter::apps {

// A size at which the labels are legible on a phone.
inline constexpr int kPagePlotWidth_px = 480;
inline constexpr int kPagePlotHeight_px = 360;

struct PagePlot {
  Plot plot;
  std::string caption;  // also the alternative text
};

// Figures of the plots as SVG. A plot without anything to draw is omitted; if gnuplot fails or is
// missing, its message replaces the plot.
Html plot_figures(const std::vector<PagePlot>& plots);

}  // namespace scattermeter::apps
