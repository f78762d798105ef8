// Reading of a rig's calibration.camera: a board seen from several directions.
#pragma once

#include <string>

#include "apps/rig/yaml_field.h"
#include "calib/lens/board_shots.h"

namespace scattermeter::apps {

// Throws InputError with file, line, field and value.
calib::BoardShots read_camera_calibration(const YamlField& field, const std::string& rig_path);

// The part of a rig that `calibrate camera` needs. The rig need not be complete: the file of its
// intrinsics may not exist yet.
struct RigCameraToCalibrate {
  std::string model;  // "": any
  int width_px = 0;
  int height_px = 0;
  double max_megapixels = 0;  // limits.raw_megapixels
  calib::BoardShots calibration;
};

// Reads camera.model, camera.image_size_px and calibration.camera. Throws InputError as above.
RigCameraToCalibrate read_camera_to_calibrate(const std::string& rig_path);

}  // namespace scattermeter::apps
