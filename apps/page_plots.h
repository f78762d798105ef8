// Plots on a page.
#pragma once

#include <string>
#include <vector>

#include "apps/html_page.h"
#include "apps/plot.h"

namespace scattermeter::apps {

// Of a size whose letters can be read on a phone.
inline constexpr int kPagePlotWidth_px = 480;
inline constexpr int kPagePlotHeight_px = 360;

struct PagePlot {
  Plot plot;
  std::string caption;  // says what is to be seen, also to those who don't see it
};

// Figures with the plots as pictures. A plot without anything to draw is left out; where gnuplot
// fails or is missing, its message stands in the plot's place.
Html plot_figures(const std::vector<PagePlot>& plots);

}  // namespace scattermeter::apps
