// The calibration shots of a rig, for `calibrate` and `check`.
#pragma once

#include <optional>
#include <string>

#include "calib/led/led_calibration_shots.h"
#include "calib/lens/board_shots.h"
#include "calib/radiance/radiance_calibration_shots.h"

namespace scattermeter::apps {

class YamlField;

// The rig's section `calibration`. Every part may be absent.
struct RigCalibration {
  std::optional<calib::BoardShots> camera;
  std::optional<calib::LedCalibrationShots> led;
  std::optional<calib::RadianceCalibrationShots> radiance;
};

// Throws InputError with file, line, field and value.
RigCalibration read_calibration(const YamlField& field, const std::string& rig_path);

}  // namespace scattermeter::apps
