// The careful search of outlines, where the quick look found something.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/rig/rig.h"
#include "capture/shots/shot_source.h"
#include "core/camera/camera_pose.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

// How far the object's outline may lie farther in than that of its mesh, px: its edges may be cut
// back by edge_std_mm, of which the outline of a bevel seen from any side shows some 0.7.
double edge_cut_px(const CameraIntrinsics& intrinsics, const ObjectScene& object,
                   const PoseResult& pose);

// Whether the careful search finds the outline in all of these shots (in four, if there are more)
// where the rig puts it. The quick look may take the dark side of a body for background.
bool closer_look_agrees(const Rig& rig, const ObjectScenes& objects, const PoseResult& pose,
                        const capture::FrameSource& frames, const std::vector<std::size_t>& shots);

}  // namespace scattermeter::apps
