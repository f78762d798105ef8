// A rig's calibration.camera: boards seen from several sides.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/yaml_field.h"
#include "calib/calibration_board.h"

namespace scattermeter::apps {

// Where the camera stands, with the board in the world's plane z = 0, its origin in the world's.
struct RigBoardPlace {
  Eigen::Vector3d position_mm;
  Eigen::Vector3d look_at_mm;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
};

struct RigBoardShot {
  std::string file;
  std::optional<RigBoardPlace> place;  // simulate only
  int line = 0;
};

struct RigCameraCalibration {
  calib::CalibrationBoard board;
  double board_std_mm = 0;  // of each coordinate of a printed corner
  std::vector<RigBoardShot> shots;
  int line = 0;
};

// Throws InputError with file, line, field and value.
RigCameraCalibration read_camera_calibration(const YamlField& field, const std::string& rig_path);

// What `calibrate camera` needs of a rig, which need not be complete: the intrinsics that it names
// may not be there yet.
struct RigCameraToCalibrate {
  std::string model;  // "": any
  int width_px = 0;
  int height_px = 0;
  double max_megapixels = 0;  // limits.raw_megapixels
  RigCameraCalibration calibration;
};

// Reads camera.model, camera.image_size_px and calibration.camera. Throws InputError as above.
RigCameraToCalibrate read_camera_to_calibrate(const std::string& rig_path);

}  // namespace scattermeter::apps
