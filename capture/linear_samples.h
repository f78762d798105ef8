// From a decoded raw frame to linear samples with noise.
#pragma once

#include "capture/noise_model.h"
#include "capture/raw_frame.h"
#include "core/cfa_samples.h"

namespace scattermeter::capture {

// The samples of a rectangle of the frame: black subtracted, variance by the noise model, clipped
// samples marked by clip_levels(). Where black lies less than four read-noise deviations above zero
// the camera cuts the noise off: floor_counts then is the level from which on that no longer biases
// a mean, four deviations above the cut. Precondition (std::invalid_argument): the rectangle lies
// in the frame, exposure_s > 0.
CfaSamples linear_samples(const RawFrame& frame, const SensorNoise& sensor, double exposure_s,
                          int x0, int y0, int width, int height);

}  // namespace scattermeter::capture
