// A shot of another object than the one the rig states.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/looks/finding.h"
#include "apps/rig/rig.h"
#include "calib/pose/outline_contour.h"
#include "calib/pose/outline_look.h"
#include "capture/shots/shot_source.h"
#include "core/camera/camera_pose.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

using Contours = std::map<std::string, std::vector<calib::ContourPoint>>;  // by object

// The finding that the outline in a shot is nine tenths that of another object, and by a tenth more
// of it than of its own. look: at the contour of its own object. Absent where none is. Opens the
// frame if there are other objects.
std::optional<Finding> other_outline(const Rig& rig, const ObjectScenes& objects,
                                     const PoseResult& pose, const Contours& contours,
                                     std::size_t shot_idx, const calib::OutlineLook& look,
                                     const capture::FrameSource& frames);

}  // namespace scattermeter::apps
