// A radiance calibration from a rig's dark frames, flats, white reference and glare shots.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/radiance_file.h"
#include "apps/rig.h"
#include "capture/raw_frame.h"

namespace scattermeter::apps {

// Opens one of the rig's shots by the name that the rig gives it.
using RadianceFrameSource = std::function<capture::RawFrame(const RadianceShot& shot)>;

struct RadianceResult {
  RadianceCalibration calibration;
};

// Dark frames -> black, dark current, hot pixels, read noise; pairs of flats -> gain; the series of
// flats -> linearity and exposure times (calib/response_fit.h); glare shot; mean of the flats less
// glare -> vignetting; white reference -> responsivity. Throws InputError, naming file, value and
// what is expected, for: shots of more than one size, ISO or aperture; dark frames with light on
// them; flats that are clipped, too dark, or without one pair of equal exposure and lamp; fewer
// than three exposure times; a trap or a white plane out of the frame; noise that does not grow
// with the light. Frames are opened one after the other, at most two at a time are kept.
RadianceResult calibrate_radiance(const Rig& rig, const RadianceFrameSource& open);

// Value, standard deviation, unit of each result, then residuals.
std::string radiance_table(const RadianceCalibration& calibration);

}  // namespace scattermeter::apps
