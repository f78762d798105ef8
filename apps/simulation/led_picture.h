// Pictures of the mirror spheres and white planes of an LED's calibration.
#pragma once

#include <vector>

#include "apps/rig/rig.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

// Radiance of the whole frame, W/(mm^2 sr), row by row, each pixel in the channel of its own
// filter, as a camera at `view` sees it. Spheres: paint_spheres(). A plane: albedo / pi times the
// irradiance by the LED (by its disc if radius_mm is not 0) plus the rig's ambient irradiance,
// pixels at its border by the covered share of their area. If the rig has a board, it is behind.
std::vector<float> led_picture(const Rig& rig, const calib::LedCalibrationShot& shot,
                               const CameraView& view);

}  // namespace scattermeter::apps
