// Initial estimate of the lens and the board poses.
#pragma once

#include <vector>

#include "calib/lens/camera_bundle.h"

namespace scattermeter::calib {

// Focal length (fx = fy) and poses of all views, accurate enough for adjust_bundle(). The focal
// lengths that follow from the homographies (Z. Zhang, "A flexible new technique for camera
// calibration", 2000, section 3.1, with the principal point at the frame centre and square pixels)
// and a series of others are tried, each with planar poses, and adjusted with Cauchy's loss; the
// one with the smallest median residual is returned. Unusable views (with wrong corners) get an
// arbitrary pose. Not converged if no start converges. Precondition: at least four corners, not on
// a line, in each view.
CameraBundle start_camera(const std::vector<BoardView>& views, int width_px, int height_px);

// The pose of one view for a given lens, robust against wrong corners.
Rigid3d board_pose(const BoardView& view, const CameraIntrinsics& intrinsics);

// Median length of the residuals of all views, px; infinite if more than half of the corners have
// no image.
double median_residual_px(const std::vector<BoardView>& views, const CameraBundle& bundle,
                          int width_px, int height_px);

}  // namespace scattermeter::calib
