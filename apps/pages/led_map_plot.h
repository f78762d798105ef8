// Plot of the predicted uncertainty over LED positions.
#pragma once

#include "apps/pages/page_plots.h"
#include "apps/planning/suggested_shots.h"

namespace scattermeter::apps {

// The upper hemisphere seen from above: x and y are degrees from the zenith towards +x and +y, the
// colour is the predicted relative standard deviation of sigma_a. joined: from the planned shots
// and one more; otherwise from this one alone. The caption states the best position.
PagePlot led_map_plot(const SuggestedShots& shots, const LedMap& map, bool joined);

}  // namespace scattermeter::apps
