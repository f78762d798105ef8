// A first guess of lens and board poses.
#pragma once

#include <vector>

#include "calib/lens/camera_bundle.h"

namespace scattermeter::calib {

// Focal length (fx = fy) and poses of all views, good enough for adjust_bundle(): the homographies'
// own focal lengths (Z. Zhang, "A flexible new technique for camera calibration", 2000, section
// 3.1, with the centre in the frame's middle and square pixels) and a ladder of others are tried,
// each with planar poses, and adjusted with Cauchy's loss; the one with the least median residual
// stands. Views of no use (wrong corners) get some pose. Not converged where no start led anywhere.
// Precondition: four corners or more, not on a line, in each view.
CameraBundle start_camera(const std::vector<BoardView>& views, int width_px, int height_px);

// The pose of one view for a given lens, wrong corners hardly pulling it.
Rigid3d board_pose(const BoardView& view, const CameraIntrinsics& intrinsics);

// Median length of all views' residuals, px; infinite where more than half have no image.
double median_residual_px(const std::vector<BoardView>& views, const CameraBundle& bundle,
                          int width_px, int height_px);

}  // namespace scattermeter::calib
