// Reading of a rig's calibration.led: mirror spheres and a white plane under each LED.
#pragma once

#include <string>

#include "apps/rig/yaml_field.h"
#include "calib/led/led_calibration_shots.h"

namespace scattermeter::apps {

// Throws InputError with file, line, field and value.
calib::LedCalibrationShots read_led_calibration(const YamlField& field,
                                                const std::string& rig_path);

}  // namespace scattermeter::apps
