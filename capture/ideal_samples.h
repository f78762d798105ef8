// Linear samples of a sensor that neither adds noise nor rounds.
#pragma once

#include <vector>

#include "capture/raw_frame.h"
#include "capture/sensor.h"
#include "core/cfa_samples.h"

namespace scattermeter::capture {

// The rectangle [x0, x0 + width) x [y0, y0 + height) of a frame whose expected signal above black
// is `signal_counts` (of the rectangle, row by row, in counts), taken as it is: what remains of an
// estimate's error on these is the method's own. The variance is that of the raw sample nearest to
// the signal, so that the samples weigh as much as those of a shot. Clipped is what the converter
// or the top of the tone curve would have cut; nothing is cut at zero (floor_counts 0).
// std::invalid_argument when the number of values is not width * height, for a rectangle that
// starts before the frame, or exposure_s <= 0.
CfaSamples ideal_samples(const std::vector<float>& signal_counts, int x0, int y0, int width,
                         int height, const SensorModel& sensor, const CfaPattern& cfa,
                         double exposure_s);

}  // namespace scattermeter::capture
