// How well a rig's pose points agree with the best camera pose.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/looks/finding.h"
#include "apps/rig/rig.h"
#include "core/camera/camera_pose.h"

namespace scattermeter::apps {

// Points that scatter by far more than the rig states about the best pose: lens or marks are not as
// stated, and no pose is right. shots: those from that pose, as indices into the scene's.
std::optional<Finding> scattered_points(const Rig& rig, const PoseResult& pose,
                                        const std::vector<std::size_t>& shots);

}  // namespace scattermeter::apps
