// The samples of a shot, through whatever calibration the rig has.
#pragma once

#include <string>

#include "apps/rig.h"
#include "capture/corrected_samples.h"
#include "capture/raw_frame.h"

namespace scattermeter::apps {

// A rectangle of the frame: capture::corrected_samples() with camera.radiance, else
// capture::linear_samples() with camera.sensor (what shots share is then 0). Throws InputError,
// naming `file`, for a frame that the calibration does not hold for.
capture::CorrectedSamples shot_samples(const Rig& rig, const capture::RawFrame& frame,
                                       const std::string& file, int x0, int y0, int width,
                                       int height);

}  // namespace scattermeter::apps
