// The rig: everything the program is told about camera, objects, lights and shots.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "apps/rig_calibration.h"
#include "apps/rig_limits.h"
#include "apps/rig_sensor_truth.h"
#include "calib/camera_model.h"
#include "calib/charuco_board.h"
#include "calib/led_uncertainty.h"
#include "calib/pose.h"
#include "capture/noise_model.h"
#include "capture/raw_frame.h"
#include "core/environment.h"
#include "core/led.h"
#include "core/medium.h"
#include "core/probe_projection.h"

namespace scattermeter::calib {
struct CameraCalibrationFile;  // calib/camera_calibration_file.h
}

namespace scattermeter::apps {

struct RadianceCalibration;  // apps/radiance_file.h

// What is known of the sensor. Read by `simulate` to make raws and by `measure` for the noise;
// black, white and filter phase of a measured raw come from the raw itself.
struct RigSensor {
  capture::SensorNoise noise;
  capture::CfaPattern cfa;
  std::array<int, 4> black_counts = {64, 64, 64, 64};
  int white_counts = 4095;
  bool nef_lossy_curve = false;
};

struct RigCamera {
  std::string model;  // "": any
  calib::CameraIntrinsics intrinsics;
  std::string intrinsics_path;  // of the file that holds them; "": none
  // All that this file says of the lens; null: none, the lens counts as exact.
  std::shared_ptr<const calib::CameraCalibrationFile> lens;
  std::string radiance_path;
  // Counts per (W/(mm^2 sr)) and second; absent: the scale is free.
  std::optional<std::array<double, 3>> responsivity;
  double responsivity_relative_std = 0.02;
  // From `calibrate radiance`; absent: the raws are taken as they are. A responsivity in it stands
  // above.
  std::shared_ptr<const RadianceCalibration> radiance;
  RigSensor sensor;
  std::optional<double> exposure_s;  // simulate only; absent: chosen so that nothing clips
  int iso = 100;
  double f_number = 8.0;
};

struct RigPose {
  std::vector<calib::PointPair> points;  // one or the other
  std::optional<calib::CharucoBoard> charuco;
  // With charuco: the one shot of the board, taken from where all others are; "": it is in each.
  std::string board_shot;
  calib::PoseOptions options;
  bool refine_by_silhouette = false;
  double edge_std_px = 0.1;  // see calib::SilhouetteOptions::line_std_px
  bool per_shot = false;     // the camera may have moved between the shots; always, with a board
  int line = 0;
};

struct RigObject {
  std::string name;
  std::string mesh_path;
  double eta_int_over_ext = 1.3;
  double eta_std = 0;
  std::optional<double> patch_size_mm;
  int line = 0;
};

struct RigEnvironment {
  std::string image_path;
  // Given: this picture instead of the file (a rig made in code); its own projection and rotation
  // are not used.
  std::shared_ptr<const Environment> image;
  ProbeProjection projection = ProbeProjection::kEquirectangular;
  Eigen::Quaterniond world_from_probe = Eigen::Quaterniond::Identity();
  Eigen::Array3d radiance_W_per_mm2_sr = Eigen::Array3d::Ones();  // of a probe value of 1
};

// An LED, or an environment where one is given. Ambient light is an even environment without a
// picture, of a radiance that is fitted along within its prior.
struct RigLight {
  std::string name;
  Led led;
  std::optional<RigEnvironment> environment;
  double position_std_mm = 0;  // in each coordinate
  double exponent_std = 0;
  bool is_ambient = false;
  Eigen::Array3d ambient_std_W_per_mm2_sr = Eigen::Array3d::Zero();  // infinite: free
  double power_relative_std = 0;  // common to the three channels of one fit
  // Of an LED from a file of `calibrate led`: in place of the three deviations above.
  std::optional<calib::LedUncertainty> calibrated;
  std::string calibration_path;  // "": none
  // With a calibrated intensity: the responsivity that it counts for.
  std::optional<std::array<double, 3>> calibrated_for;
  int line = 0;

  // Whether each colour falls on the object in its own way.
  bool colours_differ() const { return environment && !is_ambient; }
  // What the light's IncidentLight counts in: an LED's intensity on its axis, W/sr, or the radiance
  // of a probe value of 1, W/(mm^2 sr).
  const Eigen::Array3d& power() const {
    return environment ? environment->radiance_W_per_mm2_sr : led.intensity_W_per_sr;
  }
};

struct RigShot {
  std::string file;
  std::string object;
  std::string material;
  std::vector<std::string> lights;
  std::optional<double> exposure_s;  // simulate only
  // A bracket: further exposures of the same scene, merged with the first, which names the shot and
  // in whose counts it is told.
  std::vector<std::string> more_files;
  std::vector<double> more_exposures_s;  // of these, or empty; simulate only
  int line = 0;

  std::vector<std::string> files() const;  // the first and the others
};

struct RigTruthPose {
  Eigen::Vector3d position_mm;
  Eigen::Vector3d look_at_mm;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

struct Rig {
  std::string path;  // as given
  RigLimits limits;
  RigCamera camera;
  RigPose pose;
  std::vector<RigObject> objects;
  std::vector<RigLight> lights;
  std::vector<RigShot> shots;
  RigCalibration calibration;
  // simulate only.
  std::map<std::string, std::array<Medium, 3>>
      truth_materials;  // eta is the object's, not set here
  std::optional<RigTruthPose> truth_pose;
  RigSensorTruth truth_sensor;
  // R, G, B; of light beside the LEDs on the white planes of calibration.led, the same all over.
  Eigen::Array3d truth_ambient_irradiance_W_per_mm2 = Eigen::Array3d::Zero();

  const RigObject& object(const std::string& name) const;  // std::out_of_range
  const RigLight& light(const std::string& name) const;
  // Materials in the order of their first shot.
  std::vector<std::string> materials() const;
  // "rig.yaml:12" for messages.
  std::string at(int line) const { return path + ":" + std::to_string(line); }
};

// Reads and checks a rig file (YAML). Throws InputError with file, line, field and value for
// anything that is missing, of the wrong kind, out of range, not finite, unknown, given twice or
// not referred to properly. Paths in the rig are relative to the rig's folder. Meshes are not
// opened here.
// with_radiance off: camera.radiance is left out (`calibrate radiance` makes that file).
Rig read_rig(const std::string& path, bool with_radiance = true);

}  // namespace scattermeter::apps
