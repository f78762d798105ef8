// Mistakes in the list of an LED's calibration shots.
#pragma once

#include <string>

#include "calib/led/led_calibration_input.h"
#include "calib/led/led_fit.h"
#include "calib/led/led_shots.h"

namespace scattermeter::calib {

// Where `fit` leaves more of the planes' shading unexplained than their noise: the usual mistake
// without which it fits at least three times as well (by the median departure of the cells; with
// all highlights), as advice; "" if there is none. Tried are the spheres' diameter given as their
// radius, the shots of two planes exchanged, and those of the spheres exchanged with another
// LED's; if it is none of these, a plane up to 10 mm from its stated height. A lobe that departs
// from the model does so with each of them. Reads the shots again, and fits some of their cells up
// to twelve times a plane.
std::string likely_mistake(const LedCalibrationInput& input, const std::string& light,
                           const LedFrames& frames, const LedShots& shots, const LedFit& fit,
                           const LedFitOptions& options);

}  // namespace scattermeter::calib
