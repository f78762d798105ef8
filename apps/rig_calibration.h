// The calibration shots of a rig: what `calibrate` works on, and `check` holds the rig against.
#pragma once

#include <optional>

#include "apps/rig_camera_calibration.h"
#include "apps/rig_led_calibration.h"
#include "apps/rig_radiance_calibration.h"
#include "apps/yaml_field.h"

namespace scattermeter::apps {

// The rig's section `calibration`. Every part may be absent.
struct RigCalibration {
  std::optional<RigCameraCalibration> camera;
  std::optional<RigLedCalibration> led;
  std::optional<RigRadianceCalibration> radiance;
};

// Throws InputError with file, line, field and value.
RigCalibration read_calibration(const YamlField& field, const std::string& rig_path);

}  // namespace scattermeter::apps
