// Plots of the results of a material.
#pragma once

#include <vector>

#include "apps/instrument/measure.h"
#include "apps/pages/page_plots.h"

namespace scattermeter::apps {

// r(d) with error bars and the dipole for the estimated coefficients; for a transport estimate also
// the fitted dipole. Empty if r(d) was not recovered.
std::vector<PagePlot> reflectance_plots(const ChannelResult& result);

// The 95 % region of (sigma_s', sigma_a), with the estimates from single shots that lie nearby.
// Empty without an estimate.
std::vector<PagePlot> ellipse_plots(const ChannelResult& result);

}  // namespace scattermeter::apps
