// The camera's pose, from what the rig gives.
#pragma once

#include <cstddef>
#include <string>

#include "apps/camera_view.h"
#include "apps/object_scene.h"
#include "apps/rig.h"
#include "apps/shot_source.h"
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

// Where the rig's pose comes from one shot of a board (pose.shot): its corners become the rig's
// points, as if they had been given. Throws InputError when the shot is missing or does not show
// the board.
void take_points_from_board_shot(const std::string& shots_folder, Rig& rig);
// The same from that shot; name: for messages. Precondition: the rig's pose comes from one.
void take_points_from_board_shot(const capture::RawFrame& frame, const std::string& name, Rig& rig);

// `prior` (of points or board) and the objects' silhouettes together: of one shot, or of all shots
// of a source, by one camera that stood still. Throws InputError naming the rig's line and the shot
// (of several: the first) when the silhouette is not found or contradicts the prior.
calib::PoseResult pose_from_silhouette(const Rig& rig, const ObjectScenes& scenes,
                                       const calib::PoseResult& prior, std::size_t shot_idx,
                                       const capture::RawFrame& frame, const std::string& name);
calib::PoseResult pose_from_silhouettes(const Rig& rig, const ObjectScenes& scenes,
                                        const calib::PoseResult& prior, const ShotSource& source);

}  // namespace scattermeter::apps
