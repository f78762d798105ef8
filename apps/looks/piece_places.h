// Pieces put where the shots show them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/looks/finding.h"
#include "apps/looks/outline_watch.h"
#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/base/progress.h"
#include "core/scene/object_scene.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

// For every object that is to be found (SceneObject::to_be_found), in up to four of its shots, each
// under other lights where there are such: sets world_from_mesh to the position found, and
// position_std_mm to its standard deviation along the least certain axis, or that of the turn at a
// distance of the piece's size if that is larger. Returns one sentence for each. The points of a
// board shot must have been taken (calib::take_points_from_board_shot()). Throws InputError naming
// the line of the rig and the shots where a piece is not found.
std::vector<std::string> place_pieces(Rig& rig, const std::string& shots_folder,
                                      Progress* progress = nullptr);

// What the outlines of the objects say in shots that have their own poses, without a diagnosis, by
// up to four shots of each object: those that stand elsewhere than position_std_mm, the size of the
// mesh and the outline's own errors allow (by four of their deviations, or p below 1e-4); for the
// others the shifts to their most probable position, by outline and rig, where these move a view
// visibly (kVisibleMotion). Not judged: objects without straight edges, those that are to be found,
// and those whose outline is not found or differs between the shots. Takes some tenths of a second
// a shot. frames: of the source of the shots.
OutlineFindings look_at_pieces(const Rig& rig, const ObjectScenes& objects,
                               const std::vector<ObservedShot>& shots,
                               const capture::FrameSource& frames);

// The same for one object in shots from a common pose; absent where it is not judged or stands as
// stated. shots: indices into the scene's, not empty.
std::optional<Finding> misplaced_piece(const Rig& rig, const ObjectScenes& objects,
                                       const std::string& object, const PoseResult& pose,
                                       std::vector<std::size_t> shots,
                                       const capture::FrameSource& frames);

}  // namespace scattermeter::apps
