// The camera's pose in a scene's shots, from points, a board or silhouettes.
#pragma once

#include <cstddef>
#include <string>

#include "calib/pose/pose.h"
#include "calib/pose/pose_source.h"
#include "capture/raw/raw_frame.h"
#include "capture/shots/shot_source.h"
#include "core/scene/object_scene.h"
#include "core/scene/scene.h"

namespace scattermeter::calib {

// Pose from point pairs. Throws InputError naming the line when the layout is degenerate or no pose
// explains it.
PoseResult pose_from_points(const Scene& scene, const PoseSource& source);

// The points that the pose does not explain, "points[3] (57 px off), points[5] (9.1 px off)", as
// they are numbered in the rig; "" if there are none. The distance is left out where it is unknown.
std::string left_out_points(const PoseResult& pose);

// Pose from the ChArUco board in the shot. Throws InputError naming the shot when the board is not
// found or does not determine the pose.
PoseResult pose_from_board(const Scene& scene, const PoseSource& source,
                           const capture::RawFrame& frame, const std::string& path);

// If the pose is estimated from a single shot of a board (pose.shot), makes the board corners in
// that shot the points of the source, as if they had been given. Throws InputError when the shot is
// missing or does not show the board.
void take_points_from_board_shot(const Scene& scene, const capture::ShotDecoding& decoding,
                                 const std::string& shots_folder, PoseSource& source);
// The same for the frame of that shot; name: for messages. Precondition: there is such a shot.
void take_points_from_board_shot(const capture::RawFrame& frame, const std::string& name,
                                 PoseSource& source);

// Pose from `prior` (from points or a board) combined with the silhouettes of the objects in one
// shot, or in all shots of a source with a camera that did not move. Throws InputError naming the
// line and the shot (the first of several) when the silhouette is not found or contradicts the
// prior.
PoseResult pose_from_silhouette(const Scene& scene, const PoseSource& source,
                                const ObjectScenes& objects, const PoseResult& prior,
                                std::size_t shot_idx, const capture::RawFrame& frame,
                                const std::string& name);
PoseResult pose_from_silhouettes(const Scene& scene, const PoseSource& source,
                                 const ObjectScenes& objects, const PoseResult& prior,
                                 const capture::ShotSource& shots);

}  // namespace scattermeter::calib
