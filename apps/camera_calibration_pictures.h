// Pictures of a camera's calibration.
#pragma once

#include <string>

#include "calib/camera_calibration.h"

namespace scattermeter::apps {

// Where each corner's residual (projected - found) points, over the frame, enlarged so that the
// longest spans a twelfth of the frame; the title says by how much. Corners left out are marked.
// `path`: .png or .svg. Throws InputError when it cannot be drawn or written (apps/plot.h).
void draw_camera_residuals(const calib::CameraCalibration& calibration, const std::string& path);

// The found corners over the frame, a look for each view in turn.
void draw_camera_coverage(const calib::CameraCalibration& calibration, const std::string& path);

}  // namespace scattermeter::apps
