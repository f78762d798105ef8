// Plots of linearity and noise of a radiance calibration.
#pragma once

#include <cstddef>

#include "apps/report/plot.h"
#include "capture/sensor/radiance_calibration.h"

namespace scattermeter::apps {

// Recorded over linear counts minus one, in percent, over the signal: the response curve with one
// standard deviation to either side, and the means of the flats.
Plot linearity_plot(const capture::RadianceCalibration& calibration);

// Variance over signal of the pairs of flats of one colour, as recorded, and the noise model.
// colour: 0 for R, 1 for G, 2 for B.
Plot photon_transfer_plot(const capture::RadianceCalibration& calibration, std::size_t colour);

}  // namespace scattermeter::apps
