// Plots of spheres and white planes under the LEDs.
#pragma once

#include <vector>

#include "apps/pages/page_plots.h"
#include "calib/led/led_calibration.h"
#include "calib/led/led_check.h"

namespace scattermeter::apps {

// Two maps for each plane shot of a check: measured over predicted minus one, first all in percent,
// then all in standard deviations. All maps of a kind share one scale: the largest magnitude
// without the outermost 2 % of the cells, and at least 0.1 % or 3 standard deviations.
std::vector<PagePlot> led_plane_plots(const std::vector<calib::LedCheck>& leds);

// Of a calibration whose status is kOk: predicted minus measured position of each highlight; the
// lobe's light against the angle from the axis, as measured on the planes and as fitted, and their
// difference; then the maps as above, of the fitted LED. Those without data are omitted.
std::vector<PagePlot> led_fit_plots(const calib::LedCalibration& calibration);

}  // namespace scattermeter::apps
