// What a ChArUco board makes bright around a body.
#pragma once

#include "calib/board/charuco_board.h"
#include "core/camera/camera_model.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/rigid3d.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter::calib {

// Marks as kSampleDefect every sample that shows the board's paper, or lies within border_px of one
// that does: white squares and bits, and the blank margin of half a square around the print. Black
// squares stay as they are, and so do samples where the body is seen before the board: a step from
// body to ink is an edge of the body, one from body to paper may be hidden by the pattern's own.
// Precondition: border_px >= 0, a board without a board_problem() (std::invalid_argument).
void mask_paper(const CharucoBoard& board, const RayScene& body, const CameraIntrinsics& intrinsics,
                const Rigid3d& camera_from_world, int border_px, CfaSamples& samples);

}  // namespace scattermeter::calib
