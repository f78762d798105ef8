// The turn of the camera that brings a body's predicted outline near the one in the shots.
#pragma once

#include <optional>
#include <vector>

#include "calib/pose/edge_points.h"
#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// Size of the cells of the coarse search, px of the raw: a power of 2 of which at most 260 are in
// the width, at least 2.
int coarse_cell_px(int width_px);

// Among all shifts of the image by whole cells of coarse_cell_px(), up to the share `search` of the
// frame's width in each direction, the one with the best mean contrast
// (inside - outside) / (inside + outside) over the contours of all shots, as a turn of the camera
// about its own centre. None where that contrast is below 0.25 (0 is chance, 1 the best), the best
// shift lies at an end of the search, or no contour is in view. Precondition: at least one shot.
std::optional<Rigid3d> turn_coarsely(const std::vector<EdgeShot>& shots,
                                     const CameraIntrinsics& intrinsics,
                                     const Rigid3d& camera_from_world, double search);

}  // namespace scattermeter::calib
