// Plots of a material's results.
#pragma once

#include <vector>

#include "apps/measure.h"
#include "apps/page_plots.h"

namespace scattermeter::apps {

// r(d) with error bars, and the dipole: of the answer, and of the dipole's own fit where transport
// answers. Nothing where the image was not asked for r(d).
std::vector<PagePlot> reflectance_plots(const ChannelResult& result);

// 95 % region of (sigma_s', sigma_a), with each shot's own answer where it lies near. Nothing
// without an answer.
std::vector<PagePlot> ellipse_plots(const ChannelResult& result);

}  // namespace scattermeter::apps
