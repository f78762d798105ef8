// Plots of a camera calibration.
#pragma once

#include "apps/report/plot.h"
#include "calib/lens/camera_calibration.h"

namespace scattermeter::apps {

// The residuals (projected - found) of the corners as arrows over the frame, magnified so that the
// longest spans a twelfth of the frame; the title states the factor. Excluded corners are marked.
Plot camera_residual_plot(const calib::CameraCalibration& calibration);

// The corners found over the frame, with a colour and shape for each view.
Plot camera_coverage_plot(const calib::CameraCalibration& calibration);

}  // namespace scattermeter::apps
