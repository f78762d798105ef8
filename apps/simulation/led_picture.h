// What the camera sees of a LED's mirror spheres or white plane.
#pragma once

#include <vector>

#include "apps/rig/rig.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Mirrors reflect this share; below the mirror lies a weak diffuse base.
inline constexpr double kMirrorReflectance = 0.9;
inline constexpr double kMirrorBaseAlbedo = 0.02;
// Radius of the shining disc of an LED whose radius_mm is 0: a point has no image of any size.
inline constexpr double kChipRadius_mm = 0.5;

// Radiance of the whole frame, W/(mm^2 sr), row by row, each pixel in the channel of its own
// filter; `view` is where the camera stands. Spheres: the LED's disc as each sphere mirrors it
// (spheres hide it and each other, shadows included), blurred by the lens to a standard deviation
// of 0.7 px, on the diffuse base; no second reflections. A plane: albedo / pi times the irradiance
// of the LED (of its disc where it has a radius_mm) and the rig's ambient one, pixels at its border
// by the share of their area. A rig with a board has the board behind.
std::vector<float> led_picture(const Rig& rig, const calib::LedCalibrationShot& shot,
                               const CameraView& view);

}  // namespace scattermeter::apps
