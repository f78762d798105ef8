// Linear samples of a raw frame with their variances.
#pragma once

#include "capture/raw/raw_frame.h"
#include "capture/sensor/noise_model.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::capture {

// The samples of a rectangle of the frame, in px, with black subtracted, variances from the noise
// model, and clipped samples marked by clip_levels(). Where black is less than four standard
// deviations of the read noise above zero, the camera clips the noise: floor_counts is then the
// level above which this does not bias a mean, four standard deviations above zero. Throws
// std::invalid_argument for a rectangle that is not inside the frame, or exposure_s <= 0.
CfaSamples linear_samples(const RawFrame& frame, const SensorNoise& sensor, double exposure_s,
                          int x0, int y0, int width, int height);

}  // namespace scattermeter::capture
