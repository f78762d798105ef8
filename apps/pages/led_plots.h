// Plots of the white planes under the LEDs.
#pragma once

#include <vector>

#include "apps/pages/page_plots.h"
#include "calib/led/led_check.h"

namespace scattermeter::apps {

// Two maps for each plane shot: measured over predicted minus one, first all in percent, then all
// in standard deviations. All maps of a kind share one scale: the largest magnitude without the
// outermost 2 % of the cells, and at least 0.1 % or 3 standard deviations.
std::vector<PagePlot> led_plane_plots(const std::vector<calib::LedCheck>& leds);

}  // namespace scattermeter::apps
