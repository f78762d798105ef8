// A rig's calibration.camera: boards seen from several sides.
#pragma once

#include <string>

#include "apps/yaml_field.h"

namespace scattermeter::apps {

struct RigCameraCalibration {};

// Throws InputError with file, line, field and value.
RigCameraCalibration read_camera_calibration(const YamlField& field, const std::string& rig_path);

}  // namespace scattermeter::apps
