// Blur of the shots, and its effect on the estimates.
#pragma once

#include <span>
#include <vector>

#include "apps/rig/rig.h"
#include "capture/raw/raw_frame.h"
#include "core/camera/camera_pose.h"
#include "core/estimation/channel_result.h"
#include "core/scene/object_scene.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

// Blur of the object's outline in a frame, on the object (DecodedShot::edge_blur_mm), beyond the
// 0.3 px that a sharp edge may seem to have; 0 for a round body, and where the outline is not seen
// well enough.
double edge_blur_mm(const Rig& rig, const ObjectScenes& objects, const SceneShot& shot,
                    const capture::RawFrame& frame, const PoseResult& pose);

// Adds the effect of the largest blur of its shots to each estimate, up to 2 (blur / mean free
// path)^2 of sigma_s', and refuses those that it may change by more than 3 %. Those that are
// refused already are told that their shots are blurred, if by more than 0.8 px. fx_px: focal
// length of the camera.
void widen_by_blur(std::span<const ObservedShot> shots, double fx_px,
                   std::vector<ChannelResult>& results);

}  // namespace scattermeter::apps
