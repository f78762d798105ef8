// White planes under the LEDs, as pictures on a page.
#pragma once

#include <vector>

#include "apps/led_check.h"
#include "apps/page_plots.h"

namespace scattermeter::apps {

// Two maps for each plane shot: measured over predicted less one, first all in percent, then all in
// standard deviations. All maps of a kind have one scale, so that they can be compared: the largest
// magnitude but for the outermost 2 % of the cells, and at least 0.1 % or 3 deviations.
std::vector<PagePlot> led_plane_plots(const std::vector<LedCheck>& leds);

}  // namespace scattermeter::apps
