// Plots of a camera calibration.
#pragma once

#include <string>

#include "calib/lens/camera_calibration.h"

namespace scattermeter::apps {

// The residuals (projected - found) of the corners as arrows over the frame, magnified so that the
// longest spans a twelfth of the frame; the title states the factor. Excluded corners are marked.
// `path`: .png or .svg. Throws InputError when it cannot be drawn or written (apps/report/plot.h).
void draw_camera_residuals(const calib::CameraCalibration& calibration, const std::string& path);

// The corners found over the frame, with a colour and shape for each view.
void draw_camera_coverage(const calib::CameraCalibration& calibration, const std::string& path);

}  // namespace scattermeter::apps
