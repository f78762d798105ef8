// A rig's calibration.led: mirror spheres and a white plane under each LED.
#pragma once

#include <string>

#include "apps/yaml_field.h"

namespace scattermeter::apps {

struct RigLedCalibration {};

// Throws InputError with file, line, field and value.
RigLedCalibration read_led_calibration(const YamlField& field, const std::string& rig_path);

}  // namespace scattermeter::apps
