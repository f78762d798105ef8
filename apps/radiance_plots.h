// Linearity and noise of a radiance calibration, as pictures.
#pragma once

#include <cstddef>

#include "apps/plot.h"
#include "apps/radiance_file.h"

namespace scattermeter::apps {

// Recorded counts over light less one, percent, over the signal: the curve with one standard
// deviation to both sides, and the flats' means.
Plot linearity_plot(const RadianceCalibration& calibration);

// Variance over signal of a colour's pairs of flats, as recorded, and the noise model. colour:
// 0 R, 1 G, 2 B.
Plot photon_transfer_plot(const RadianceCalibration& calibration, std::size_t colour);

}  // namespace scattermeter::apps
