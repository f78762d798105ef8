// Plots of a material's results.
#pragma once

#include <vector>

#include "apps/measure.h"
#include "apps/page_plots.h"

namespace scattermeter::apps {

// r(d) with error bars, and the dipole: of the answer, and of the dipole's own fit where transport
// answers. Nothing where the image was not asked for r(d).
std::vector<PagePlot> reflectance_plots(const ChannelResult& result);

// 95 % regions of (sigma_s', sigma_a) of a material's channels, with each shot's own answer.
// Nothing without an answer.
std::vector<PagePlot> ellipse_plots(const std::vector<const ChannelResult*>& channels);

}  // namespace scattermeter::apps
