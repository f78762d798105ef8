// Reading of a rig's pose: how the position of the camera is found.
#pragma once

#include "apps/rig/yaml_field.h"
#include "calib/pose/pose_source.h"

namespace scattermeter::apps {

// Reads the section `pose`. Throws InputError with file, line, field and value.
calib::PoseSource read_pose(const YamlField& field);

}  // namespace scattermeter::apps
