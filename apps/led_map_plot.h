// A map of LED positions as a picture.
#pragma once

#include "apps/other_shots.h"
#include "apps/page_plots.h"

namespace scattermeter::apps {

// The upper half sphere seen from above: x and y are degrees from the zenith towards +x and +y, the
// colour is the relative standard deviation of sigma_a. joined: of the planned shots and one more;
// else of this one alone. The caption names the best place.
PagePlot led_map_plot(const OtherShots& shots, const LedMap& map, bool joined);

}  // namespace scattermeter::apps
