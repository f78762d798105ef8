// The rig: the description of camera, objects, lights and shots.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include <Eigen/Core>

#include "apps/rig/rig_calibration.h"
#include "apps/rig/rig_limits.h"
#include "calib/pose/pose_source.h"
#include "capture/sensor/sensor_truth.h"
#include "capture/shots/shot_decoding.h"
#include "core/material/medium.h"
#include "core/scene/scene.h"

namespace scattermeter::calib {
struct CameraCalibrationFile;  // calib/lens/camera_calibration_file.h
}

namespace scattermeter::apps {

// Pose of the camera of simulated shots.
struct CameraPlacement {
  Eigen::Vector3d position_mm;
  Eigen::Vector3d look_at_mm;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

// The true values, for simulation only, which may differ from those that the rig states.
struct Truth {
  std::map<std::string, std::array<Medium, 3>> materials;  // eta is the object's, not set here
  std::optional<CameraPlacement> pose;
  capture::SensorTruth sensor;
  // R, G, B: uniform irradiance by other light than the LEDs' on the white planes of
  // calibration.led.
  Eigen::Array3d ambient_irradiance_W_per_mm2 = Eigen::Array3d::Zero();
};

// A rig file as values.
struct Rig {
  std::string path;  // as given
  Scene scene;
  calib::PoseSource pose;
  capture::ShotDecoding decoding;  // with camera.radiance, if given
  // The file of camera.intrinsics; null if there is none.
  std::shared_ptr<const calib::CameraCalibrationFile> lens;
  std::string intrinsics_path;  // of that file; empty if there is none
  RigCalibration calibration;
  Truth truth;
  RigLimits limits;

  // "rig.yaml:12" for messages.
  std::string at(int line) const { return path + ":" + std::to_string(line); }
};

// Files that a folder of this rig's shots may contain besides the shots: those of the calibrations
// and of the board.
std::set<std::string> calibration_files(const Rig& rig);

// The noise that counts: the radiance calibration's (of green), or else that of camera.sensor.
SensorNoise noise_in_force(const Rig& rig);

// Sets the calibration by which the rig's shots are corrected (null: none). Its responsivity is not
// used. path: of its file; empty if it was made in code.
void use_radiance(Rig& rig, std::shared_ptr<const capture::RadianceCalibration> radiance,
                  const std::string& path = {});

// Reads and checks a rig file (YAML). Throws InputError with file, line, field and value for
// anything that is missing, of the wrong kind, out of range, not finite, unknown, given twice or an
// unresolved reference. Paths in the rig are relative to its folder. Meshes are not opened. Without
// with_radiance, camera.radiance is ignored, as for `calibrate radiance`, which makes that file.
Rig read_rig(const std::string& path, bool with_radiance = true);

}  // namespace scattermeter::apps
