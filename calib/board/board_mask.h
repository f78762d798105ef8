// Mask of the bright paper of a ChArUco board around a body.
#pragma once

#include "calib/board/charuco_board.h"
#include "core/camera/camera_model.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/rigid3d.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter::calib {

// Marks as kSampleDefect every sample that shows the board's paper (white squares and bits, and the
// blank margin of half a square around the print) or lies within border_px of such a sample. Black
// squares are not marked, nor are samples where the body is in front of the board: a step from body
// to ink is an edge of the body, but a step from body to paper may be hidden by the edges of the
// pattern. Throws std::invalid_argument for border_px < 0 and for a board that board_problem()
// rejects.
void mask_paper(const CharucoBoard& board, const RayScene& body, const CameraIntrinsics& intrinsics,
                const Rigid3d& camera_from_world, int border_px, CfaSamples& samples);

}  // namespace scattermeter::calib
