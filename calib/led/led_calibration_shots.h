// The shots from which LEDs are calibrated: mirror spheres and a white plane under each LED.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "calib/led/led_fit.h"
#include "calib/led/mirror_sphere.h"
#include "calib/led/white_plane.h"

namespace scattermeter::calib {

enum class LedShotKind {
  kSpheres,
  kPlane,
  kAmbient,  // a plane with every LED off
};

struct LedCalibrationShot {
  std::string file;
  LedShotKind kind = LedShotKind::kSpheres;
  std::size_t plane = 0;             // index into LedCalibrationShots::planes, unless kSpheres
  std::string light;                 // name of the LED; "" for kAmbient, which serves all LEDs
  std::optional<double> exposure_s;  // for simulation only
  int line = 0;                      // in LedCalibrationShots::path
};

struct LedCalibrationShots {
  std::vector<MirrorSphere> spheres;
  std::vector<WhitePlane> planes;
  std::vector<LedCalibrationShot> shots;
  AmbientModel ambient = AmbientModel::kWhereSeen;
  std::string path;  // file that lists the shots, for messages
  int line = 0;

  // Names of the LEDs in the order of their first shots.
  std::vector<std::string> lights() const;
  // Index into `shots` of a plane's ambient shot, if there is one.
  std::optional<std::size_t> ambient_shot(std::size_t plane_idx) const;
  // "rig.yaml:12" for messages.
  std::string at(int line_number) const { return path + ":" + std::to_string(line_number); }
};

}  // namespace scattermeter::calib
