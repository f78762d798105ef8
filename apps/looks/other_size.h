// A piece that is not of its mesh's size.
#pragma once

#include <optional>

#include "apps/looks/finding.h"
#include "capture/raw/raw_frame.h"
#include "core/camera/camera_model.h"
#include "core/camera/camera_pose.h"
#include "core/camera/sensor_noise.h"
#include "core/scene/object_scene.h"

namespace scattermeter::apps {

// The size from half to twice that of the mesh, 5 % and more off, with which the outline in the
// frame fits by nine tenths, wherever the object stands, to a tenth or so; absent where there is
// none. Without shots. Looks some fifty times, for where the outline of the mesh itself fits
// nowhere.
std::optional<Finding> other_size(const ObjectScene& object, const CameraIntrinsics& intrinsics,
                                  const PoseResult& pose, const capture::RawFrame& frame,
                                  const SensorNoise& noise);

}  // namespace scattermeter::apps
