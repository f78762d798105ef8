// A rig's calibration.led: mirror spheres and a white plane under each LED.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/yaml_field.h"
#include "calib/mirror_sphere.h"
#include "calib/white_plane.h"

namespace scattermeter::apps {

struct RigLedShot {
  std::string file;
  bool is_plane = false;  // else the spheres
  std::size_t plane = 0;  // which one stands there
  std::string light;
  std::optional<double> exposure_s;  // simulate only
  int line = 0;
};

struct RigLedCalibration {
  std::vector<calib::MirrorSphere> spheres;
  std::vector<calib::WhitePlane> planes;
  std::vector<RigLedShot> shots;
  int line = 0;

  // Lights in the order of their first shot.
  std::vector<std::string> lights() const;
};

// Throws InputError with file, line, field and value.
RigLedCalibration read_led_calibration(const YamlField& field, const std::string& rig_path);

}  // namespace scattermeter::apps
