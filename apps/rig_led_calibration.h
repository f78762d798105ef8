// A rig's calibration.led: mirror spheres and a white plane under each LED.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/yaml_field.h"
#include "calib/led_fit.h"
#include "calib/mirror_sphere.h"
#include "calib/white_plane.h"

namespace scattermeter::apps {

enum class LedShotKind {
  kSpheres,
  kPlane,
  kAmbient,  // of a plane with every LED off
};

struct RigLedShot {
  std::string file;
  LedShotKind kind = LedShotKind::kSpheres;
  std::size_t plane = 0;             // which one stands there, if any
  std::string light;                 // "" of an ambient shot, which is that of all lights
  std::optional<double> exposure_s;  // simulate only
  int line = 0;
};

struct RigLedCalibration {
  std::vector<calib::MirrorSphere> spheres;
  std::vector<calib::WhitePlane> planes;
  std::vector<RigLedShot> shots;
  calib::AmbientModel ambient = calib::AmbientModel::kWhereSeen;
  int line = 0;

  // Lights in the order of their first shot.
  std::vector<std::string> lights() const;
  // Place in `shots` of a plane's ambient shot, if there is one.
  std::optional<std::size_t> ambient_shot(std::size_t plane) const;
};

// Throws InputError with file, line, field and value.
RigLedCalibration read_led_calibration(const YamlField& field, const std::string& rig_path);

}  // namespace scattermeter::apps
