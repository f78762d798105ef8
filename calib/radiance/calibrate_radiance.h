// Radiance calibration of a camera from dark frames, flats, a white reference and glare shots.
#pragma once

#include <functional>

#include "calib/radiance/radiance_calibration_input.h"
#include "capture/raw/raw_frame.h"
#include "capture/sensor/radiance_calibration.h"

namespace scattermeter::calib {

// Opens one of the listed shots.
using RadianceFrames = std::function<capture::RawFrame(const RadianceShot& shot)>;

// Dark frames -> black, dark current, hot pixels, read noise; pairs of flats -> gain; the series of
// flats -> linearity and exposure times (calib/radiance/response_fit.h); glare shot; mean of the
// flats less glare -> vignetting; white reference -> responsivity. Throws InputError, naming file,
// value and what is expected, for: shots of more than one size, ISO or aperture; dark frames with
// light on them; flats that are clipped, too dark, or without one pair of equal exposure and lamp;
// fewer than three exposure times; a trap or a white plane out of the frame; noise that does not
// grow with the light. Frames are opened one after the other, and at most two are kept at a time.
// Throws std::invalid_argument for a white reference without white_led.
capture::RadianceCalibration calibrate_radiance(const RadianceCalibrationInput& input,
                                                const RadianceFrames& open);

}  // namespace scattermeter::calib
