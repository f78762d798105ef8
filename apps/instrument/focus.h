// Blur of the shots.
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

// Blur of the object's outline in a frame beyond the 0.3 px that a sharp edge may seem to have.
EdgeBlur edge_blur(const Rig& rig, const ObjectScenes& objects, const SceneShot& shot,
                   const capture::RawFrame& frame, const PoseResult& pose);

// Refuses estimates whose shots are blurred by more than six tenths of the mean free path, beyond
// which the light's second derivatives (core/view/row_blur.h) no longer tell what blur does. Those
// that are refused already are told that their shots are blurred, if by more than 0.8 px. fx_px:
// focal length of the camera.
void refuse_blurred(std::span<const ObservedShot> shots, double fx_px,
                    std::vector<ChannelResult>& results);

}  // namespace scattermeter::apps
