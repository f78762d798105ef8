// Coarse search for the rotation of the camera that aligns the predicted outline of a body with the
// shots.
#pragma once

#include <optional>
#include <vector>

#include "calib/pose/edge_points.h"
#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// Size of the cells of the coarse search, in px of the raw file: a power of 2, at least 2, such
// that the width has at most 260 cells.
int coarse_cell_px(int width_px);

// The camera pose after a rotation about its own centre that corresponds to the best shift of the
// image: among all shifts by whole cells of coarse_cell_px(), up to the share `search` of the frame
// width in each direction, the one with the highest mean contrast (inside - outside) / (inside +
// outside) over the contours of all shots. None if that contrast is below 0.25 (0 is chance, 1 the
// maximum), the best shift lies at an end of the search, or no contour is in view. Precondition: at
// least one shot.
std::optional<Rigid3d> turn_coarsely(const std::vector<EdgeShot>& shots,
                                     const CameraIntrinsics& intrinsics,
                                     const Rigid3d& camera_from_world, double search);

}  // namespace scattermeter::calib
