// Where the outlines of pieces show them, by the careful search about where the rig states them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/looks/finding.h"
#include "apps/looks/moved_piece.h"
#include "apps/looks/outline_watch.h"
#include "apps/rig/rig.h"
#include "calib/pose/piece_pose.h"
#include "capture/shots/shot_source.h"
#include "core/scene/object_scene.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

// As many shots tell where a piece stands.
inline constexpr std::size_t kTellingShots = 4;
// Indices of such shots of the object, first those under lights that no earlier one has.
std::vector<std::size_t> telling_shots(const std::vector<SceneShot>& shots,
                                       const std::string& object);

calib::PiecePoseOptions piece_pose_options(const Rig& rig, const ObjectScene& object);

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

// What the outline of one object says in shots from a common pose: that it stands elsewhere than is
// stated, as look_at_pieces() tells, or elsewhere within that. Neither where it stands as stated
// and where it is not judged.
struct PieceLook {
  std::optional<Finding> finding;
  std::optional<MovedPiece> moved;
};
// shots: indices into the scene's, not empty.
PieceLook look_at_piece(const Rig& rig, const ObjectScenes& objects, const std::string& object,
                        const PoseResult& pose, std::vector<std::size_t> shots,
                        const capture::FrameSource& frames);
// The same of all objects with edges in shots from a common pose: findings, and where those stand
// that the rig states well enough.
OutlineFindings look_at_pieces(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose,
                               const std::vector<ObservedShot>& shots,
                               const capture::FrameSource& frames);

}  // namespace scattermeter::apps
