// The camera's pose, from what the rig gives.
#pragma once

#include "apps/camera_view.h"
#include "apps/rig.h"
#include "calib/pose.h"
#include "capture/raw_frame.h"

namespace scattermeter::apps {

// Pose from the rig's point pairs. Throws InputError naming the rig's line when the layout is
// degenerate or no pose explains it.
calib::PoseResult pose_from_points(const Rig& rig);

// Pose from the ChArUco board in the shot. Throws InputError naming the shot when the board is not
// found or does not determine the pose.
calib::PoseResult pose_from_board(const Rig& rig, const capture::RawFrame& frame,
                                  const std::string& path);

}  // namespace scattermeter::apps
