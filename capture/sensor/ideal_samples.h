// Linear samples of an ideal sensor without noise and rounding.
#pragma once

#include <vector>

#include "capture/raw/raw_frame.h"
#include "capture/sensor/sensor.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::capture {

// The samples of the rectangle [x0, x0 + width) x [y0, y0 + height) of a frame, equal to the
// expected signal above black, `signal_counts` (row by row, in counts). An estimate from them has
// only the error of its method. The variance is that of the nearest raw sample, so that the samples
// have the weights of a real shot. Samples beyond the converter or the top of the tone curve are
// clipped; nothing is clipped at zero (floor_counts is 0). Throws std::invalid_argument when the
// number of values is not width * height, for a rectangle that starts before the frame, or
// exposure_s <= 0.
CfaSamples ideal_samples(const std::vector<float>& signal_counts, int x0, int y0, int width,
                         int height, const SensorModel& sensor, const CfaPattern& cfa,
                         double exposure_s);

}  // namespace scattermeter::capture
